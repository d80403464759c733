// DEMs at odd places of the globe: built and verified, with the region that they cover, or refused
// by their cause.
#include "core/pipeline/terrain_input.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/pipeline/build.h"
#include "core/pipeline/verify/verify.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kSide = 20;

class OnTheGlobe : public ::testing::Test {
 protected:
  // Hills of 20 x 20 cells, its first cell's corner at x, y.
  void Make(const std::string& crs, double x, double y, double step_x, double step_y) {
    std::vector<double> heights;
    for (int r = 0; r < kSide; ++r) {
      for (int c = 0; c < kSide; ++c) {
        heights.push_back(std::round(500 + 300 * std::sin(c / 3.0) + 200 * std::cos(r / 2.5)));
      }
    }
    WriteTiff(dem_, {.columns = kSide,
                     .rows = kSide,
                     .values = heights,
                     .geotransform = {{x, step_x, 0, y, 0, step_y}},
                     .crs = crs});
  }
  void MakeDegrees(double west, double north, double step) {
    Make("EPSG:4326", west, north, step, -step);
  }

  // West, south, east and north of the tileset in degrees, once every claim was found to hold.
  std::array<double, 4> BuiltRegion() {
    BuildOptions options;
    options.levels = 2;
    Status built = BuildArtifacts(dem_, folder_ / "out", options, control_);
    if (!built) throw std::runtime_error(built.error().message);
    Result<std::vector<ClaimCheck>> claims =
        VerifyArtifacts(dem_, folder_ / "out", options, control_);
    if (!claims) throw std::runtime_error(claims.error().message);
    for (const ClaimCheck& check : *claims) EXPECT_TRUE(check.holds) << check.claim;
    const auto tileset = nlohmann::json::parse(SlurpFile(folder_ / "out" / "tileset.json"));
    std::array<double, 4> region{};
    for (std::size_t i = 0; i < 4; ++i) {
      region[i] =
          tileset["root"]["boundingVolume"]["region"][i].get<double>() * 180 / std::numbers::pi;
      EXPECT_LE(std::abs(region[i]), i % 2 == 0 ? 180 : 90);
    }
    return region;
  }

  Error Refusal(const BuildOptions& options = {}) {
    Result<std::unique_ptr<TerrainInput>> input = TerrainInput::Open(dem_, options, control_);
    return input ? Error{ErrorCode::kIo, "it was taken"} : input.error();
  }

  TempDir folder_;
  std::filesystem::path dem_ = folder_ / "dem.tif";
  RunControl control_;
};

TEST_F(OnTheGlobe, TheHeaderAloneIsPlacedAsTheWholeIs) {
  const auto header = [this] { return TerrainInput::Open(dem_, {}, control_, kSide * kSide - 1); };
  Make("EPSG:32610", 500000, 4000000, 30, -30);
  Result<std::unique_ptr<TerrainInput>> input = header();
  ASSERT_TRUE(input) << input.error().message;
  EXPECT_TRUE((*input)->HeaderOnly());
  EXPECT_EQ((*input)->georeference().CrsName(), "EPSG:32610");
  input = TerrainInput::Open(dem_, {}, control_, kSide * kSide);
  ASSERT_TRUE(input);
  EXPECT_FALSE((*input)->HeaderOnly());

  MakeDegrees(7, 500, 0.001);
  input = header();
  ASSERT_FALSE(input);
  EXPECT_EQ(input.error().kind, "outside-crs");
  Make("EPSG:32610", 0, 0, 1e300, -1e300);
  input = header();
  ASSERT_FALSE(input);
  EXPECT_EQ(input.error().kind, "outside-crs");
  // The row beyond the pole may have no data.
  MakeDegrees(7, 90.0015, 0.001);
  EXPECT_TRUE(header());
}

// Its cells are not even looked at: the words are no numbers, and most are not there.
TEST_F(OnTheGlobe, OfTextTheHeaderAloneIsPlacedToo) {
  BuildOptions options;
  options.crs = "EPSG:32610";
  const auto header = [&](const std::string& name, const std::string& text) {
    SpillFile(folder_ / name, text);
    return TerrainInput::Open(folder_ / name, options, control_, 2999);
  };
  const std::string arc = "ncols 60\nnrows 50\nxllcorner 500000\nyllcorner 4000000\ncellsize 30\n";
  const std::string grass =
      "north: 4001500\nsouth: 4000000\neast: 501800\nwest: 500000\nrows: 50\ncols: 60\n";
  const std::string surfer = "DSAA\n60 50\n500015 501785\n4000015 4001485\n0 100\n";
  const std::pair<const char*, std::string> grids[] = {
      {"a.asc", arc + "1 x"}, {"b.txt", grass + "1 x"}, {"c.grd", surfer + "1 x"}};
  for (const auto& [name, text] : grids) {
    Result<std::unique_ptr<TerrainInput>> input = header(name, text);
    ASSERT_TRUE(input) << name << ": " << input.error().message;
    EXPECT_TRUE((*input)->HeaderOnly()) << name;
    EXPECT_EQ((*input)->posts(), 3000) << name;
  }
  std::string points;
  for (int i = 0; i < 3000; ++i) {
    points += std::to_string(500000 + 30 * (i % 60)) + " " +
              std::to_string(4000000 + 30 * (i / 60)) + " 5\n";
  }
  Result<std::unique_ptr<TerrainInput>> list = header("d.xyz", points);
  ASSERT_TRUE(list) << list.error().message;
  EXPECT_TRUE((*list)->HeaderOnly());
  EXPECT_EQ((*list)->posts(), 3000);

  const std::string far = "ncols 60\nnrows 50\nxllcorner 7e9\nyllcorner 4000000\ncellsize 30\n";
  Result<std::unique_ptr<TerrainInput>> outside = header("a.asc", far);
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().kind, "outside-crs");
}

TEST_F(OnTheGlobe, ARegionAcross180DegreesHasItsWestEastOfItsEast) {
  for (const double turn : {0.0, -360.0}) {
    MakeDegrees(179.99 + turn, 51.5, 0.001);
    EXPECT_THAT(BuiltRegion(), ElementsAre(DoubleNear(179.9905, 1e-5), DoubleNear(51.4805, 1e-5),
                                           DoubleNear(-179.9905, 1e-5), DoubleNear(51.4995, 1e-5)));
  }
}

TEST_F(OnTheGlobe, LongitudesTo360AreTaken) {
  MakeDegrees(190, 51, 0.001);
  EXPECT_THAT(BuiltRegion(), ElementsAre(DoubleNear(-169.9995, 1e-5), ::testing::_,
                                         DoubleNear(-169.9805, 1e-5), ::testing::_));
}

TEST_F(OnTheGlobe, ATileThatEndsAt180DegreesDoesNotGoOver) {
  MakeDegrees(180 - 0.0195, 51, 0.001);
  const std::array<double, 4> west_of_it = BuiltRegion();
  EXPECT_NEAR(west_of_it[0], 179.981, 1e-5);
  EXPECT_EQ(west_of_it[2], 180);
  MakeDegrees(-180.0005, 51, 0.001);
  const std::array<double, 4> east_of_it = BuiltRegion();
  EXPECT_EQ(east_of_it[0], -180);
  EXPECT_NEAR(east_of_it[2], -179.981, 1e-5);
}

TEST_F(OnTheGlobe, ARegionAroundAPoleGoesAllTheWayRound) {
  Make("EPSG:3031", -10000, 10000, 1000, -1000);  // the pole between posts
  const std::array<double, 4> south = BuiltRegion();
  EXPECT_EQ(south[0], -180);
  EXPECT_EQ(south[1], -90);
  EXPECT_EQ(south[2], 180);
  EXPECT_LT(south[3], -89.8);
  Make("EPSG:3413", -9500, 9500, 1000, -1000);  // the pole at a post
  const std::array<double, 4> north = BuiltRegion();
  EXPECT_EQ(north[0], -180);
  EXPECT_EQ(north[2], 180);
  EXPECT_NEAR(north[3], 90, 1e-5);
}

TEST_F(OnTheGlobe, ARegionBesideAPoleIsNoWiderThanTheMesh) {
  Make("EPSG:3995", -10000, 40000, 1000, -1000);  // 20 to 40 km from the pole, about 180 degrees
  const std::array<double, 4> region = BuiltRegion();
  EXPECT_NEAR(region[0], 180 - std::atan2(9500, 20500) * 180 / std::numbers::pi, 0.01);
  EXPECT_NEAR(region[2], -region[0], 0.01);
}

TEST_F(OnTheGlobe, ColumnsFromTheEastMakeTheSameRegion) {
  Make("EPSG:32613", 500000, 4500000, 30, -30);
  const std::array<double, 4> plain = BuiltRegion();
  Make("EPSG:32613", 500000 + kSide * 30, 4500000, -30, -30);
  const std::array<double, 4> mirrored = BuiltRegion();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(mirrored[i], plain[i], 1e-5);
}

TEST_F(OnTheGlobe, AsMuchAsThePlaneMayHoldIsBuilt) {
  MakeDegrees(0, 14, 1.4);
  BuiltRegion();
  MakeDegrees(-170, 80, 0.5);
  BuiltRegion();
}

TEST_F(OnTheGlobe, MoreIsRefusedAsTooLarge) {
  for (const double step : {2.0, 9.0}) {
    MakeDegrees(0, 10 * step, step);
    const Error error = Refusal();
    EXPECT_EQ(error.kind, "too-large-extent") << error.message;
    EXPECT_THAT(error.message, HasSubstr("gdal_translate"));
  }
  Make("EPSG:3413", -3e6, 3e6, 3e5, -3e5);
  EXPECT_EQ(Refusal().kind, "too-large-extent");
}

TEST_F(OnTheGlobe, PostsAtAPoleOrBeyondAreRefusedWithTheRowsToCut) {
  MakeDegrees(10, 90.05, 0.1);
  const Error at = Refusal();
  EXPECT_EQ(at.kind, "cells-too-narrow");
  EXPECT_THAT(at.message, HasSubstr("gdal_translate -srcwin 0 1 20 19 "));
  EXPECT_THAT(at.message, HasSubstr("EPSG:3413"));
  MakeDegrees(10, 90.19, 0.1);
  const Error beyond = Refusal();
  EXPECT_EQ(beyond.kind, "outside-crs");
  EXPECT_THAT(beyond.message, HasSubstr("gdal_translate -srcwin 0 2 20 18 "));
  MakeDegrees(10, -88.05, 0.1);
  EXPECT_THAT(Refusal().message, HasSubstr("EPSG:3031"));
}

TEST_F(OnTheGlobe, CellsWithoutExtentAreTooNarrow) {
  Make("EPSG:32632", 0, 0, 1e-40, -1e-40);
  EXPECT_EQ(Refusal().kind, "cells-too-narrow");
}

TEST_F(OnTheGlobe, AWrongReferenceSystemIsNamed) {
  MakeDegrees(-105.5, 40.2, 0.001);
  BuildOptions utm;
  utm.crs = "EPSG:32613";
  const Error degrees = Refusal(utm);
  EXPECT_EQ(degrees.kind, "cells-too-narrow");
  EXPECT_THAT(degrees.message, HasSubstr("EPSG:32613"));
  EXPECT_THAT(degrees.message, HasSubstr("--crs"));
  MakeDegrees(-105.5, 40.2, 0.1);
  const Error coarse = Refusal(utm);
  EXPECT_EQ(coarse.kind, "outside-crs");
  EXPECT_THAT(coarse.message, HasSubstr("look like degrees"));
  Make("EPSG:4326", 500000, 4500000, 30, -30);
  EXPECT_EQ(Refusal().kind, "outside-crs");
  Make("EPSG:3857", 20037508 - 300, 5000000, 30, -30);
  const Error over = Refusal();
  EXPECT_EQ(over.kind, "outside-crs");
  EXPECT_THAT(over.message, HasSubstr("over its edge"));
}

TEST_F(OnTheGlobe, APlaceFarOutsideTheAreaOfUseIsSaid) {
  Make("EPSG:32632", 2600000, 1200000, 30, -30);
  Result<std::unique_ptr<TerrainInput>> far = TerrainInput::Open(dem_, {}, control_);
  ASSERT_TRUE(far) << far.error().message;
  const auto says = [](const TerrainInput& input) {
    return std::ranges::any_of(input.assumptions(),
                               [](const Assumption& a) { return a.code == "outside-area"; });
  };
  EXPECT_TRUE(says(**far));
  Make("EPSG:32632", 600000, 5200000, 30, -30);
  Result<std::unique_ptr<TerrainInput>> near = TerrainInput::Open(dem_, {}, control_);
  ASSERT_TRUE(near) << near.error().message;
  EXPECT_FALSE(says(**near));
}

}  // namespace
}  // namespace farhorizon
