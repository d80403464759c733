#include "core/pipeline/compare/compare_picture.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "tests/support/placed_dem.h"

namespace farhorizon {
namespace {

GridMesh InGrid(const PlainMesh& mesh) {
  GridMesh grid;
  for (const auto& [c, r, h] : mesh.points) grid.points.push_back({c, r, h});
  for (const auto& [a, b, c] : mesh.triangles) {
    grid.triangles.push_back(
        {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
  }
  return grid;
}

class SkylinePairsTest : public testing::Test {
 protected:
  std::vector<SkylinePair> PairsOf(const PlainMesh& mesh) {
    const Terrain& terrain = dem_.input().terrain();
    horizon_ = *FindHorizon(terrain, {}, {});
    return *SkylinePairs(dem_.input(), terrain, horizon_, InGrid(mesh));
  }

  PlacedDem dem_;
  Horizon horizon_;
};

TEST_F(SkylinePairsTest, OfTheDemsOwnMeshAreTheSame) {
  const auto pairs = PairsOf(dem_.InPosts());
  ASSERT_EQ(pairs.size(), 4U);
  for (const SkylinePair& pair : pairs) {
    double greatest = 0;
    int seen = 0;
    for (std::size_t i = 0; i < pair.dem_m.size(); ++i) {
      if (!std::isfinite(pair.dem_m[i]) || !std::isfinite(pair.mesh_m[i])) continue;
      greatest = std::max(greatest, std::abs(pair.dem_m[i] - pair.mesh_m[i]));
      ++seen;
    }
    EXPECT_GT(seen, 1100) << pair.azimuth_deg;
    EXPECT_LT(greatest, 1e-9) << pair.azimuth_deg;
  }
}

TEST_F(SkylinePairsTest, SeeAPeakWhereItStands) {
  // A peak in the north-east: towards north it is to the right, towards east to the left.
  PlainMesh mesh = dem_.InPosts();
  mesh.points[3 * PlacedDem::kColumns + 25][2] = 5000;
  const auto pairs = PairsOf(mesh);
  const auto offset = [](const SkylinePair& pair) {
    const auto top = std::ranges::max_element(
        pair.mesh_m, [](double a, double b) { return std::isnan(a) || a < b; });
    return pair.offsets_m[static_cast<std::size_t>(top - pair.mesh_m.begin())];
  };
  // (25 - 14.5) columns of 77.4 m, and (9.5 - 3) rows of 111.2 m.
  EXPECT_NEAR(offset(pairs[0]), 813, 5);
  EXPECT_NEAR(offset(pairs[2]), -723, 5);
}

TEST(MapOf, KeepsTheGreatestErrorOfPostsThatFallTogether) {
  Dem dem;
  dem.columns = 400;
  dem.rows = 3;
  std::vector<double> errors(1200, 0.5);
  errors[401] = -7;
  errors[402] = std::nan("");
  const ErrorMap map = MapOf(errors, dem, 0.7);
  EXPECT_EQ(map.columns, 134);
  EXPECT_EQ(map.rows, 1);
  EXPECT_EQ(map.aspect, 0.7);
  EXPECT_EQ(map.errors_m[0], -7);
  EXPECT_EQ(map.errors_m[1], 0.5);
}

}  // namespace
}  // namespace farhorizon
