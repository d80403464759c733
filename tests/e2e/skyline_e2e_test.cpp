// `farhorizon skyline` as it is typed.
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/hilly_grid.h"
#include "tests/support/json_schema.h"
#include "tests/support/service_process.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class SkylineE2e : public testing::Test {
 protected:
  void SetUp() override { SpillFile(folder_ / "hills.asc", HillyGrid(40, 30)); }

  /// The exit status of `farhorizon COMMAND hills.asc` with all that a text grid leaves open, and
  /// what is added.
  int Run(const std::string& command, const std::vector<std::string>& added) {
    std::vector<std::string> words = {
        FARHORIZON_PROGRAM, command,     Path("hills.asc"), "--crs", "EPSG:4326",
        "--vertical-datum", "ellipsoid", "--height-unit",   "m"};
    words.insert(words.end(), added.begin(), added.end());
    return Process(words, {}, folder_ / "stderr").Wait(std::chrono::seconds(300));
  }
  [[nodiscard]] std::string Path(const std::string& file) const {
    return (folder_ / file).string();
  }
  [[nodiscard]] std::string Text(const std::string& file) const {
    return SlurpFile(folder_ / file);
  }
  [[nodiscard]] std::string Said() const { return Text("stderr"); }

  TempDir folder_;
};

/// Whether [[from, to], ...], each standing for its opposite too, hold the azimuth, to a tenth of a
/// degree: they are measured at the edge, and the azimuth at the DEM's middle.
bool Hold(const json& azimuths, double azimuth) {
  for (const json& interval : azimuths) {
    for (int turn = -2; turn <= 4; ++turn) {
      const double turned = azimuth + 180 * turn;
      if (turned > interval[0].get<double>() - 0.1 && turned < interval[1].get<double>() + 0.1) {
        return true;
      }
    }
  }
  return false;
}

TEST_F(SkylineE2e, NamesHorizonEdgesThatAreSeenThereFromLeftToRight) {
  ASSERT_EQ(Run("horizon", {"-o", Path("horizon.geojson")}), 0) << Said();
  const auto name = [](const json& p) { return p["a"].dump() + p["b"].dump(); };
  std::map<std::string, json> azimuths;
  const json horizon = json::parse(Text("horizon.geojson"));
  for (const json& feature : horizon["features"]) {
    const json& p = feature["properties"];
    azimuths[name(p)] = p["azimuths"];
  }
  const json shape = json::parse(
      SlurpFile(std::string(FARHORIZON_SOURCE_DIR) + "/proto/schemas/skyline.schema.json"));
  for (const char* azimuth : {"0", "30", "90", "211.5", "-45"}) {
    ASSERT_EQ(Run("skyline", {"--azimuth", azimuth, "-o", Path("skyline.geojson")}), 0) << Said();
    const json skyline = json::parse(Text("skyline.geojson"));
    EXPECT_THAT(SchemaOffences(skyline, shape), testing::IsEmpty());
    EXPECT_EQ(skyline["azimuth"], std::stod(azimuth));
    EXPECT_GT(skyline["features"].size(), 20U);
    double reached = skyline["features"][0]["properties"]["offset_m"][0];
    for (const json& feature : skyline["features"]) {
      const json& p = feature["properties"];
      const auto edge = azimuths.find(name(p));
      ASSERT_NE(edge, azimuths.end()) << p;
      EXPECT_TRUE(Hold(edge->second, std::stod(azimuth))) << p << azimuth << edge->second;
      EXPECT_NEAR(p["offset_m"][0].get<double>(), reached, 1e-3) << "no gap, no overlap";
      reached = p["offset_m"][1];
    }
  }
}

TEST_F(SkylineE2e, FromBehindHasTheSameEndsAndTheSameSummitMirrored) {
  struct Outline {
    double left = 0;
    double right = 0;
    double summit = 0;
    double height = -1;
  };
  // Of several summits of one height the leftmost, or the rightmost.
  const auto outline = [&](const char* azimuth, bool leftmost) {
    EXPECT_EQ(Run("skyline", {"--azimuth", azimuth, "-o", Path("skyline.geojson")}), 0) << Said();
    const json parts = json::parse(Text("skyline.geojson"))["features"];
    Outline found{parts.front()["properties"]["offset_m"][0],
                  parts.back()["properties"]["offset_m"][1]};
    for (const json& part : parts) {
      const double height = part["geometry"]["coordinates"][0][2];
      if (height < found.height || (leftmost && height == found.height)) continue;
      found.height = height;
      found.summit = part["properties"]["offset_m"][0];
    }
    return found;
  };
  const Outline front = outline("72", true);
  const Outline back = outline("252", false);
  EXPECT_NEAR(front.left, -back.right, 1e-3);
  EXPECT_NEAR(front.right, -back.left, 1e-3);
  EXPECT_NEAR(front.summit, -back.summit, 1e-3);
  EXPECT_EQ(front.height, back.height);
}

TEST_F(SkylineE2e, IsTheSameBytesForAnyNumberOfThreads) {
  for (const char* file : {"a.geojson", "a.svg"}) {
    ASSERT_EQ(Run("skyline", {"--azimuth", "10", "-o", Path(file), "--threads", "1"}), 0);
    const std::string one = Text(file);
    ASSERT_EQ(Run("skyline", {"--azimuth", "10", "-o", Path(file), "--threads", "3"}), 0);
    EXPECT_EQ(Text(file), one);
    EXPECT_EQ(Said(), "");
  }
  EXPECT_THAT(Text("a.svg"), testing::StartsWith("<svg "));
  EXPECT_THAT(Text("a.svg"), HasSubstr("hills.asc towards 10 degrees: "));
}

TEST_F(SkylineE2e, RefusesWhatIsNoAzimuthOrNoFormat) {
  for (const char* azimuth : {"361", "nan", "inf", "north"}) {
    EXPECT_EQ(Run("skyline", {"--azimuth", azimuth, "-o", Path("a.svg")}), 2) << azimuth;
    EXPECT_THAT(Said(), HasSubstr("azimuth"));
  }
  EXPECT_EQ(Run("skyline", {"-o", Path("a.svg")}), 2);
  EXPECT_THAT(Said(), HasSubstr("--azimuth"));
  EXPECT_EQ(Run("skyline", {"--azimuth", "10", "-o", Path("a.png")}), 2);
  EXPECT_THAT(Said(), HasSubstr("use .geojson or .svg"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.svg"));
}

}  // namespace
}  // namespace farhorizon
