#include "core/simplify/mesh/ground.h"

#include <gtest/gtest.h>

#include "tests/support/ascii_dem.h"

namespace farhorizon {
namespace {

TEST(Ground, HasHeightsAboveTheMiddleOfTheDemsLessTheEarthsDrop) {
  Dem dem = AsciiDem("10 20 30\n10 50 30\n10 20 30");
  dem.quantum_m = 0.5;
  dem.height_offset_m = 1000;
  const Terrain terrain = *Terrain::Build(dem);
  const Ground ground(terrain, {2, 3});
  EXPECT_EQ(ground.base_m(), 1015);
  const Place corner = ground.At(0, 2);
  EXPECT_EQ(corner.plan, -10);       // 1005 m
  EXPECT_EQ(corner.frame, -10 - 5);  // one column and one row from the middle
  EXPECT_EQ(ground.Row(2)[0], corner.frame);
  EXPECT_EQ(ground.At(1, 1).frame, 10);
  EXPECT_EQ(ground.PostAt(corner), 6);
  EXPECT_TRUE(ground.IsOwn(corner));
  EXPECT_FALSE(ground.IsOwn(ground.WithHeight(0, 2, -9)));
  EXPECT_EQ(ground.WithHeight(0, 2, -9).frame, -9 - 5);
  EXPECT_TRUE(ground.OnSide(corner));
  EXPECT_FALSE(ground.OnSide(ground.At(1, 1)));
}

TEST(Ground, GoesOnAcrossItsOutlineAsTheTriangleRightAndBelowHasIt) {
  const Dem dem = AsciiDem("10 20 30\n. 26 39\n17 20 .");
  const Terrain terrain = *Terrain::Build(dem);
  const Ground ground(terrain, {});
  const float base = static_cast<float>(ground.base_m());
  // 26 one column on, and 3 less, as the row below has it.
  EXPECT_EQ(ground.Row(1)[0] + base, 26 + 17 - 20);
  EXPECT_EQ(ground.Row(1)[1] + base, 26);
  EXPECT_EQ(ground.Row(2)[2], 0);
}

}  // namespace
}  // namespace farhorizon
