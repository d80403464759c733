#include "core/pipeline/write_skyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// Columns and rows of unequal size, and a grid whose north is turned by the meridians' convergence.
constexpr GroundStep kDegrees{66.3, 0, 0, -92.6};
constexpr GroundStep kTurned{29.98, 0.7, 0.7, -29.98};
constexpr GroundStep kMirrored{-10, 0, 0, -10};

TEST(DirectionOf, HasTheAzimuthOnTheGround) {
  for (const GroundStep& step : {kDegrees, kTurned, kMirrored}) {
    for (double azimuth = -360; azimuth <= 360; azimuth += 7.3) {
      const ViewDirection view = DirectionOf(azimuth, step);
      const double east = step.column_east_m * view.dc + step.row_east_m * view.dr;
      const double north = step.column_north_m * view.dc + step.row_north_m * view.dr;
      const double reached = std::atan2(east, north) / std::numbers::pi * 180;
      EXPECT_LT(std::abs(std::remainder(reached - azimuth, 360)), 1e-5) << azimuth;
      EXPECT_LE(std::max(std::abs(view.dc), std::abs(view.dr)), kMaxViewStep);
    }
  }
}

// No direction of small enough numbers is nearer; rounding the two alone is off by 7e-6 degrees.
TEST(DirectionOf, IsTheNearestThatNumbersOfItsSizeTell) {
  int near = 0;
  int all = 0;
  for (const GroundStep& step : {kDegrees, kTurned, kMirrored}) {
    for (double azimuth = 0.37; azimuth < 360; azimuth += 1.1) {
      const ViewDirection view = DirectionOf(azimuth, step);
      const double off = std::abs(std::remainder(step.ToAzimuth(view.dc, view.dr) - azimuth, 360));
      EXPECT_LT(off, 1e-7) << azimuth;
      near += off < 1e-10 ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GT(near, all * 9 / 10);
}

TEST(DirectionOf, IsExactAlongRowsAndColumns) {
  const auto expect = [](double azimuth, std::int32_t dc, std::int32_t dr) {
    const ViewDirection view = DirectionOf(azimuth, kDegrees);
    EXPECT_EQ(view.dc, dc) << azimuth;
    EXPECT_EQ(view.dr, dr) << azimuth;
  };
  expect(0, 0, -1);
  expect(90, 1, 0);
  expect(180, 0, 1);
  expect(-90, -1, 0);
  expect(360, 0, -1);
}

TEST(SkylineFormatOf, GoesByTheEnding) {
  EXPECT_EQ(*SkylineFormatOf("a/b.geojson"), SkylineFormat::kGeoJson);
  EXPECT_EQ(*SkylineFormatOf("b.svg"), SkylineFormat::kSvg);
  EXPECT_EQ(SkylineFormatOf("b.json").error().kind, "unknown-format");
}

}  // namespace
}  // namespace farhorizon
