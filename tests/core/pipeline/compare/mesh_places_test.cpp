#include "core/pipeline/compare/mesh_places.h"

#include <gtest/gtest.h>

#include "tests/support/placed_dem.h"

namespace farhorizon {
namespace {

TEST(MeshPlaces, OfAPartAreThoseOfItsPosts) {
  const PlacedDem dem;
  CoveredPart part{dem.input().dem(), {4, 3}};
  part.dem.columns = 5;
  part.dem.rows = 2;
  part.dem.heights.assign(10, 700);
  MeshPlaces places(dem.input());
  const auto whole = places.For(MeshFrame::kEcef, nullptr);
  const auto of_part = places.For(MeshFrame::kTile, &part);
  ASSERT_TRUE(whole) << whole.error().message;
  ASSERT_TRUE(of_part) << of_part.error().message;
  const PlainMesh expected = dem.InTileFrame();
  ASSERT_EQ(whole->positions.size(), expected.points.size());
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_NEAR(whole->positions[i][k], expected.points[i][k], 1e-6);
    }
  }
  ASSERT_EQ(of_part->positions.size(), 10U);
  EXPECT_EQ(of_part->positions[0], whole->positions[3 * 30 + 4]);
  EXPECT_EQ(of_part->positions[9], whole->positions[4 * 30 + 8]);
  EXPECT_EQ(of_part->up, whole->up);
}

TEST(MeshPlaces, OverTheGridHaveStepsAlone) {
  const PlacedDem dem;
  const auto places = MeshPlaces(dem.input()).For(MeshFrame::kPosts, nullptr);
  ASSERT_TRUE(places);
  EXPECT_TRUE(places->positions.empty());
  EXPECT_NEAR(places->column_m, 77.4, 0.5);
  EXPECT_NEAR(places->row_m, 111.2, 0.5);
}

}  // namespace
}  // namespace farhorizon
