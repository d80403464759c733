#include "core/pipeline/terrain_tiles/zoom_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// A tenth of a degree in the middle of tiles.
const PlaceBox kSmall = {
    {kHalfTurn + kHalfTurn / 36, kHalfTurn / 5},
    {kHalfTurn + kHalfTurn / 36 + kHalfTurn / 1800, kHalfTurn / 5 + kHalfTurn / 1800}};

TEST(ZoomPlan, TheClientsErrorIsThatOfCesium) {
  // TerrainProvider.getEstimatedLevelZeroGeometricErrorForAHeightmap(WGS84, 65, 2)
  EXPECT_NEAR(ClientErrorAt(0), 77067.34, 0.01);
  EXPECT_NEAR(ClientErrorAt(10), 75.26, 0.01);
}

TEST(ZoomPlan, EachZoomHasTheCoarsestLevelThatIsGoodEnough) {
  const std::vector<double> errors = {20, 100, 700};
  const ZoomPlan plan = PlanZooms(errors, 1500, kSmall);
  ASSERT_EQ(plan.size(), 12U);  // 77067 / 2^11 is 37.6 m, and at 12 less than 20
  for (std::size_t zoom = 0; zoom < plan.size(); ++zoom) {
    const double client = ClientErrorAt(static_cast<int>(zoom));
    if (!plan[zoom]) {
      EXPECT_GE(client, 1500);
      continue;
    }
    EXPECT_LE(errors[*plan[zoom]], client);
    const bool coarser_would_do =
        *plan[zoom] + 1 < errors.size() && errors[*plan[zoom] + 1] <= client;
    EXPECT_FALSE(coarser_would_do) << zoom;
  }
  EXPECT_EQ(plan.back(), 0U);
}

TEST(ZoomPlan, KeepsToItsTiles) {
  const PlaceBox degree = {{kHalfTurn, kHalfTurn / 2},
                           {kHalfTurn + kHalfTurn / 180, kHalfTurn / 2 + kHalfTurn / 180}};
  const ZoomPlan plan = PlanZooms({0.1, 200}, 3000, degree);
  std::int64_t tiles = 0;
  for (std::size_t zoom = 0; zoom < plan.size(); ++zoom) {
    tiles += CountTiles(static_cast<int>(zoom), degree);
  }
  EXPECT_LE(tiles, kMostTerrainTiles);
  EXPECT_GT(tiles + CountTiles(static_cast<int>(plan.size()), degree), kMostTerrainTiles);
  EXPECT_EQ(plan.back(), 0U);
}

TEST(ZoomPlan, TheSeaHasAZoom) {
  EXPECT_EQ(PlanZooms({0.001}, 0, kSmall).back(), 0U);
  EXPECT_EQ(PlanZooms({1e6}, 1e6, kSmall).size(), 1U);
}

TEST(ZoomPlan, CountsTilesBeyondTheMeridianOf180Degrees) {
  EXPECT_EQ(CountTiles(3, {{-1, 5}, {1, 6}}), 2);
}

}  // namespace
}  // namespace farhorizon
