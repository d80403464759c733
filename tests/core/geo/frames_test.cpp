#include "core/geo/frames.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/oracles/frames_by_formula.h"

namespace farhorizon {
namespace {

TEST(TangentFrame, AgreesWithTheClosedFormulaAllOverTheGlobe) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> lon(-180, 180);
  std::uniform_real_distribution<double> lat(-90, 90);
  std::uniform_real_distribution<double> step(-0.5, 0.5);
  for (int i = 0; i < 1000; ++i) {
    const Geodetic origin = {lon(random), lat(random), 1000};
    const TangentFrame frame(origin, by_formula::ToEcef(origin));
    const Ecef p = by_formula::ToEcef(
        {origin.lon_deg + step(random), origin.lat_deg + step(random), 3000 * step(random)});
    const Enu found = frame.ToEnu(p);
    const Enu expected = by_formula::ToEnu(origin, p);
    EXPECT_NEAR(found.east, expected.east, 1e-8);
    EXPECT_NEAR(found.north, expected.north, 1e-8);
    EXPECT_NEAR(found.up, expected.up, 1e-8);
    const Ecef back = frame.ToEcef(found);
    EXPECT_NEAR(back.x, p.x, 1e-8);
    EXPECT_NEAR(back.y, p.y, 1e-8);
    EXPECT_NEAR(back.z, p.z, 1e-8);
  }
}

TEST(TangentFrame, MovedFramesShareTheirAxesAndCountInWholeSteps) {
  const Geodetic place = {7, 46, 0};
  for (const TangentFrame& common :
       {TangentFrame(place, by_formula::ToEcef(place)), TangentFrame::EarthFixed()}) {
    const Ecef p = by_formula::ToEcef({7.9, 46.7, 2345.6});
    const Enu at = common.ToEnu(p);
    const Enu origin = {std::round(at.east / 512) * 512, std::round(at.north / 512) * 512,
                        std::round(at.up / 512) * 512};
    const TangentFrame moved = common.MovedTo(origin);
    EXPECT_EQ(moved.ToEnu(p).east, at.east - origin.east);
    EXPECT_EQ(moved.ToEnu(p).north, at.north - origin.north);
    EXPECT_EQ(moved.ToEnu(p).up, at.up - origin.up);
    const Ecef back = moved.ToEcef(moved.ToEnu(p));
    EXPECT_LT(std::hypot(back.x - p.x, back.y - p.y, back.z - p.z), 1e-8);
    const auto matrix = moved.EnuToEcef();
    const Ecef there = common.ToEcef(origin);
    EXPECT_EQ(matrix[12], there.x);
    EXPECT_EQ(matrix[14], there.z);
    EXPECT_EQ(matrix[4], common.EnuToEcef()[4]);
  }
}

TEST(TangentFrame, ItsMatrixIsARotationAndAShiftInColumns) {
  const Geodetic origin = {8, 46, 500};
  const TangentFrame frame(origin, by_formula::ToEcef(origin));
  const std::array<double, 16> m = frame.EnuToEcef();
  const Enu p = {100, -200, 300};
  const Ecef expected = frame.ToEcef(p);
  EXPECT_NEAR(m[0] * p.east + m[4] * p.north + m[8] * p.up + m[12], expected.x, 1e-9);
  EXPECT_NEAR(m[1] * p.east + m[5] * p.north + m[9] * p.up + m[13], expected.y, 1e-9);
  EXPECT_NEAR(m[2] * p.east + m[6] * p.north + m[10] * p.up + m[14], expected.z, 1e-9);
  EXPECT_EQ(m[3], 0);
  EXPECT_EQ(m[7], 0);
  EXPECT_EQ(m[11], 0);
  EXPECT_EQ(m[15], 1);
}

TEST(TangentFrame, UpLeavesTheEllipsoidAlongItsNormal) {
  const Geodetic origin = {8, 46, 500};
  const TangentFrame frame(origin, by_formula::ToEcef(origin));
  const Geodetic above = by_formula::ToGeodetic(frame.ToEcef({0, 0, 1000}));
  EXPECT_NEAR(above.lon_deg, 8, 1e-12);
  EXPECT_NEAR(above.lat_deg, 46, 1e-12);
  EXPECT_NEAR(above.height_m, 1500, 1e-7);
}

}  // namespace
}  // namespace farhorizon
