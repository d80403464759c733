// The pages of the real service, and the viewer that stands by itself.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/service_fixture.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;
using testing::Not;

class PagesE2e : public ServiceE2e {
 protected:
  // A folder that the service takes for CesiumJS.
  std::string Cesium() {
    const std::filesystem::path folder = folder_ / "cesium";
    std::filesystem::create_directories(folder / "Workers");
    SpillFile(folder / "Cesium.js", "globalThis.Cesium = {};");
    SpillFile(folder / "Workers" / "a.js", std::string(200'000, 'w'));
    return folder.string();
  }
};

TEST_F(PagesE2e, AreServedWithTheirPolicyAndNothingFromOutsideTheirFolders) {
  StartStandIn({"FARHORIZON_VIEWER_CESIUM=" + Cesium()});
  const RawAnswer index = Ask(port_, "GET", "/", "Accept: text/html\r\n");
  EXPECT_EQ(index.status, 200);
  EXPECT_THAT(index.head,
              HasSubstr("Content-Security-Policy: default-src 'none'; script-src 'self'"));
  const std::string job = Submit("small.asc");
  const RawAnswer viewer = Ask(port_, "GET", "/viewer/" + job.substr(6), "Accept: text/html\r\n");
  ASSERT_EQ(viewer.status, 200) << viewer.body;
  const std::string mark = "data-cesium=\"../";
  const std::size_t at = viewer.body.find(mark);
  ASSERT_NE(at, std::string::npos);
  const std::size_t begin = at + mark.size();
  const std::string folder =
      "/" + viewer.body.substr(begin, viewer.body.find('"', begin) - begin) + "/";
  const RawAnswer worker = Ask(port_, "GET", folder + "Workers/a.js");
  EXPECT_EQ(worker.status, 200);
  EXPECT_EQ(worker.body, std::string(200'000, 'w'));
  EXPECT_THAT(worker.head, HasSubstr("immutable"));
  for (const char* name : {"../../data/jobs.sqlite", "..%2f..%2fdata%2fjobs.sqlite",
                           "Workers/..%2f..%2fdata/jobs.sqlite", "/etc/passwd"}) {
    EXPECT_EQ(Ask(port_, "GET", folder + name).status, 404) << name;
  }
}

TEST_F(PagesE2e, ARefusedFolderOfCesiumJsIsNamed) {
  const std::string folder = (folder_ / "none").string();
  std::vector<std::string> words = Command();
  EXPECT_EQ(Process(words, {"FARHORIZON_VIEWER_CESIUM=" + folder}, folder_ / "stderr")
                .Wait(std::chrono::seconds(60)),
            1);
  EXPECT_THAT(SlurpFile(folder_ / "stderr"),
              testing::AllOf(HasSubstr(folder + " has no Cesium.js"), HasSubstr("install-cesium")));
}

TEST_F(PagesE2e, AViewerStandsBesideArtifacts) {
  const std::filesystem::path out = folder_ / "out";
  std::filesystem::create_directories(out);
  EXPECT_EQ(Run({"viewer", out.string(), "--cesium", Cesium()}), 1);
  EXPECT_THAT(SlurpFile(folder_ / "stderr"), HasSubstr("tileset.json"));
  SpillFile(out / "tileset.json", "{}");
  ASSERT_EQ(Run({"viewer", out.string(), "--cesium", Cesium()}), 0)
      << SlurpFile(folder_ / "stderr");
  const std::string page = SlurpFile(out / "viewer.html");
  EXPECT_THAT(page, HasSubstr("data-results=\"\" data-cesium=\"cesium\" data-home=\"\""));
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  EXPECT_EQ(SlurpFile(out / "cesium" / "Cesium.js"), "globalThis.Cesium = {};");
  EXPECT_TRUE(std::filesystem::exists(out / "cesium" / "Workers" / "a.js"));
}

}  // namespace
}  // namespace farhorizon
