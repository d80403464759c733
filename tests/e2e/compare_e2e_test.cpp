// `farhorizon compare` as it is typed.
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/hilly_grid.h"
#include "tests/support/service_process.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class CompareE2e : public testing::Test {
 protected:
  void SetUp() override {
    SpillFile(folder_ / "hills.asc", HillyGrid(40, 30));
    ASSERT_EQ(Run({"build", Path("hills.asc"), "--crs", "EPSG:4326", "--vertical-datum",
                   "ellipsoid", "--height-unit", "m", "--levels", "2", "-o", Path("out")}),
              0)
        << Said();
  }

  /// The exit status; standard output goes to the file `stdout`.
  int Run(const std::vector<std::string>& words) {
    std::string command = "exec \"$0\" \"$@\" >" + Path("stdout");
    std::vector<std::string> all = {"/bin/sh", "-c", command, FARHORIZON_PROGRAM};
    all.insert(all.end(), words.begin(), words.end());
    return Process(all, {}, folder_ / "stderr").Wait(std::chrono::seconds(300));
  }
  int Compare(const std::string& mesh, const std::vector<std::string>& added = {}) {
    std::vector<std::string> words = {"compare",   Path("hills.asc"), Path(mesh),
                                      "--crs",     "EPSG:4326",       "--vertical-datum",
                                      "ellipsoid", "--height-unit",   "m"};
    words.insert(words.end(), added.begin(), added.end());
    return Run(words);
  }
  [[nodiscard]] std::string Path(const std::string& file) const {
    return (folder_ / file).string();
  }
  [[nodiscard]] std::string Said() const { return SlurpFile(folder_ / "stderr"); }
  [[nodiscard]] std::string Printed() const { return SlurpFile(folder_ / "stdout"); }

  TempDir folder_;
};

TEST_F(CompareE2e, PrintsATableOfATilesetAndDrawsIt) {
  ASSERT_EQ(Compare("out/tileset.json", {"-o", Path("a.svg")}), 0) << Said();
  EXPECT_THAT(Printed(), HasSubstr("silhouette rms"));
  EXPECT_THAT(Printed(), HasSubstr("lod0.glb"));
  EXPECT_THAT(Printed(), HasSubstr("lod1.glb"));
  EXPECT_THAT(SlurpFile(folder_ / "a.svg"), testing::StartsWith("<svg "));
}

TEST_F(CompareE2e, PrintsJsonOfOneMesh) {
  ASSERT_EQ(Compare("out/lod0.glb", {"--json"}), 0) << Said();
  const json printed = json::parse(Printed());
  ASSERT_EQ(printed["meshes"].size(), 1U);
  EXPECT_EQ(printed["meshes"][0]["sound"], true);
  EXPECT_THAT(Said(), HasSubstr("assumed: the mesh's coordinates are taken for"));
}

TEST_F(CompareE2e, TellsCallsFromDataByTheExitStatus) {
  EXPECT_EQ(Compare("out/lod0.glb", {"--mesh-frame", "mars"}), 2);
  EXPECT_THAT(Said(), HasSubstr("crs, lonlat, ecef"));
  EXPECT_EQ(Compare("out/lod0.glb", {"--mesh-up", "x"}), 2);
  EXPECT_EQ(Compare("out/lod0.glb", {"-o", Path("a.png")}), 2);
  EXPECT_EQ(Compare("no.glb"), 1);
  EXPECT_THAT(Said(), HasSubstr("no.glb"));
  EXPECT_EQ(Compare("hills.asc"), 1);
  EXPECT_THAT(Said(), HasSubstr("no mesh that is read"));
  EXPECT_EQ(Compare("out/lod0.glb", {"--mesh-frame", "ecef"}), 1);
  EXPECT_THAT(Said(), HasSubstr("does not lie on the DEM"));
  SpillFile(folder_ / "flipped.obj",
            "v 0 0 600\nv 39 0 600\nv 0 29 600\nv 39 29 600\nv 2 2 600\nv 2 5 600\nv 5 2 600\n"
            "f 1 3 4\nf 1 4 2\nf 5 7 6\n");
  EXPECT_EQ(Compare("flipped.obj", {"--mesh-frame", "posts", "--mesh-up", "z"}), 1);
  EXPECT_THAT(Printed(), HasSubstr("UNSOUND"));
}

}  // namespace
}  // namespace farhorizon
