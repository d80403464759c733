// Whoever runs the program, wherever and beside whomever: the tables that decide where a terrain
// lies are those of the packages.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/hilly_grid.h"
#include "tests/support/service_process.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

namespace fs = std::filesystem;

class ReferenceDataE2e : public testing::Test {
 protected:
  void SetUp() override {
    SpillFile(folder_ / "hills.asc", HillyGrid(12, 10));
    // In all places where PROJ and GDAL would look: a database that is none, and options that
    // change what is read.
    for (const char* place : {"data", "home/.local/share/proj", "share/proj", "tmp/proj"}) {
      fs::create_directories(folder_ / place);
      SpillFile(folder_ / place / "proj.db", "not a database");
    }
    fs::create_directories(folder_ / "home/.gdal");
    SpillFile(folder_ / "home/.gdal/gdalrc", "[configoptions]\nCPL_DEBUG=ON\nGDAL_SKIP=MEM\n");
    ASSERT_EQ(Run("plain.geojson", {}), 0) << SlurpFile(folder_ / "said");
  }

  [[nodiscard]] std::vector<std::string> Words(const std::string& file) const {
    return {FARHORIZON_PROGRAM, "horizon",       "hills.asc", "-o", file, "--crs",
            "EPSG:4326+5773",   "--height-unit", "m"};
  }
  int Run(const std::string& file, const std::vector<std::string>& environment) {
    std::vector<std::string> words = {"/usr/bin/env", "-C", folder_.path().string()};
    for (const std::string& word : Words(file)) words.push_back(word);
    return Process(words, environment, folder_ / "said").Wait();
  }

  TempDir folder_;
};

TEST_F(ReferenceDataE2e, TheEnvironmentAndHomeDoNotDecide) {
  const std::string root = folder_.path().string();
  EXPECT_EQ(Run("hostile.geojson",
                {"PROJ_DATA=" + root + "/data", "PROJ_LIB=" + root + "/data",
                 "PROJ_USER_WRITABLE_DIRECTORY=" + root + "/data", "PROJ_NETWORK=ON",
                 "GDAL_DATA=" + root + "/data", "HOME=" + root + "/home",
                 "XDG_DATA_HOME=" + root + "/share", "TMPDIR=" + root + "/tmp", "CPL_DEBUG=ON",
                 "GDAL_SKIP=MEM", "OGR_SQLITE_PRAGMA=foreign_keys=1", "CPL_TIMESTAMP=YES"}),
            0)
      << SlurpFile(folder_ / "said");
  EXPECT_EQ(SlurpFile(folder_ / "hostile.geojson"), SlurpFile(folder_ / "plain.geojson"));
  EXPECT_THAT(SlurpFile(folder_ / "said"), testing::Not(testing::HasSubstr("OGR")));
}

// Without a home PROJ would look into /tmp/proj, which any user can make. A /tmp of our own stands
// in for it.
TEST_F(ReferenceDataE2e, AFolderOfTmpDoesNotDecide) {
  const std::string root = folder_.path().string();
  const auto in_namespace = [&](const std::string& script, const std::vector<std::string>& rest) {
    std::vector<std::string> words = {
        "/usr/bin/unshare", "--user", "--map-root-user", "--mount", "/bin/sh", "-c", script, "sh"};
    words.insert(words.end(), rest.begin(), rest.end());
    return Process(words, {}, folder_ / "said").Wait();
  };
  // The program may itself lie below /tmp: it is opened before.
  const std::string bind = "exec 9< \"$1\" && cd " + root + " && mount --bind tmp /tmp";
  if (in_namespace(bind, {FARHORIZON_PROGRAM}) != 0)
    GTEST_SKIP() << "no user or mount namespace can be made here";
  EXPECT_EQ(
      in_namespace(bind + " && unset HOME XDG_DATA_HOME && shift && exec /proc/self/fd/9 \"$@\"",
                   Words("tmp.geojson")),
      0)
      << SlurpFile(folder_ / "said");
  EXPECT_EQ(SlurpFile(folder_ / "tmp.geojson"), SlurpFile(folder_ / "plain.geojson"));
}

TEST_F(ReferenceDataE2e, ADefinitionOpensNoFile) {
  // Whoever opens the pipe for reading waits for a writer that never comes.
  const std::string pipe = (folder_ / "pipe").string();
  ASSERT_EQ(Process({"/usr/bin/mkfifo", pipe}, {}, folder_ / "said").Wait(), 0);
  for (const std::string& crs :
       {"+proj=longlat +datum=WGS84 +geoidgrids\t=" + pipe + " +vunits=m +type=crs",
        "+proj=longlat +datum=WGS84 +nadgrids =" + pipe + " +type=crs", "+init=" + pipe + ":x",
        "GEOGCRS[\"x\",REMARK[\"PROJ CRS string: +init=" + pipe + ":x\"]]"}) {
    fs::remove(folder_ / "said");
    std::vector<std::string> words = Words("never.geojson");
    words[2] = (folder_ / "hills.asc").string();
    words[6] = crs;
    EXPECT_EQ(Process(words, {}, folder_ / "said").Wait(), 1) << crs;
    EXPECT_THAT(SlurpFile(folder_ / "said"), testing::HasSubstr("reference system")) << crs;
  }
}

}  // namespace
}  // namespace farhorizon
