#include "core/pipeline/ground_step.h"

#include <cmath>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

constexpr GroundStep kNorthUp{30, 0, 0, -20};

TEST(GroundStep, AzimuthsRunClockwiseFromNorth) {
  EXPECT_DOUBLE_EQ(kNorthUp.ToAzimuth(0, -1), 0);
  EXPECT_DOUBLE_EQ(kNorthUp.ToAzimuth(1, 0), 90);
  EXPECT_DOUBLE_EQ(kNorthUp.ToAzimuth(2, -3), 45);
  EXPECT_DOUBLE_EQ(kNorthUp.ToAzimuth(-1, 0), -90);
  EXPECT_LT(kNorthUp.SignedCellArea(), 0);
}

TEST(GroundStep, ToGridIsTheInverseOfToAzimuthAtOneMetre) {
  for (const GroundStep& step : {kNorthUp, GroundStep{29.98, 0.7, 0.7, -29.98},
                                 GroundStep{-10, 2, 1, -15}, GroundStep{0.6, 0.8, 0.8, -0.6}}) {
    for (double azimuth = -180; azimuth <= 180; azimuth += 7.2) {
      const auto [columns, rows] = step.ToGrid(azimuth);
      const auto [east, north] = step.ToGround(columns, rows);
      EXPECT_NEAR(std::hypot(east, north), 1, 1e-12);
      EXPECT_NEAR(std::remainder(step.ToAzimuth(columns, rows) - azimuth, 360), 0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace farhorizon
