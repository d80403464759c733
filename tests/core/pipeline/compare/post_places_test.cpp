#include "core/pipeline/compare/post_places.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/placed_dem.h"

namespace farhorizon {
namespace {

TEST(PlacesFor, HasEachPostAndTheEllipsoidsNormalThere) {
  const PlacedDem dem;
  const auto places = PlacesFor(MeshFrame::kEcef, dem.input(), nullptr);
  ASSERT_TRUE(places) << places.error().message;
  const PlainMesh expected = dem.InTileFrame();
  ASSERT_EQ(places->positions.size(), expected.points.size());
  const TangentFrame& frame = dem.input().georeference().frame();
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    const auto& p = places->positions[i];
    for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(p[k], expected.points[i][k], 1e-6);
    // The normal as linear in p, against that of the latitude and longitude.
    std::array<double, 3> normal = places->up_at_origin;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        normal[row] += places->up[3 * row + axis] * p[axis];
      }
    }
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    const double lon =
        (PlacedDem::kWest + static_cast<double>(i % 30) * PlacedDem::kStep) * by_formula::kRad;
    const double lat =
        (PlacedDem::kNorth - static_cast<double>(i / 30) * PlacedDem::kStep) * by_formula::kRad;
    const Ecef foot = frame.ToEcef({0, 0, 0});
    const Enu up = frame.ToEnu({foot.x + std::cos(lat) * std::cos(lon),
                                foot.y + std::cos(lat) * std::sin(lon), foot.z + std::sin(lat)});
    EXPECT_NEAR(normal[0] / length, up.east, 1e-6);
    EXPECT_NEAR(normal[1] / length, up.north, 1e-6);
    EXPECT_NEAR(normal[2] / length, up.up, 1e-6);
  }
}

TEST(PlacesFor, OfAPartIsThatOfItsPosts) {
  const PlacedDem dem;
  CoveredPart part{dem.input().dem(), {4, 3}};
  part.dem.columns = 5;
  part.dem.rows = 2;
  part.dem.heights.assign(10, 700);
  part.dem.heights[7] = kNoHeight;
  const auto whole = PlacesFor(MeshFrame::kTile, dem.input(), nullptr);
  const auto places = PlacesFor(MeshFrame::kTile, dem.input(), &part);
  ASSERT_TRUE(places) << places.error().message;
  ASSERT_EQ(places->positions.size(), 10U);
  EXPECT_EQ(places->positions[0], whole->positions[3 * 30 + 4]);
  EXPECT_EQ(places->positions[9], whole->positions[4 * 30 + 8]);
  EXPECT_NEAR(places->column_m, 77.4, 0.5);
  EXPECT_NEAR(places->row_m, 111.2, 0.5);
  EXPECT_TRUE(PlacesFor(MeshFrame::kPosts, dem.input(), &part)->positions.empty())
      << "straight over the grid";
}

}  // namespace
}  // namespace farhorizon
