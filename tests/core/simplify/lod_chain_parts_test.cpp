// Levels that are to be cut: no edge crosses a line, and all that a level promises holds
// nevertheless.
#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/simplify/lod_chain.h"
#include "core/simplify/sides/side_posts.h"
#include "tests/support/effort.h"
#include "tests/support/level_checks.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

struct CutChain {
  CutChain(const Dem& of, const LodPlan& plan)
      : dem(of), terrain(*Terrain::Build(dem)), horizon(*FindHorizon(terrain, {}, {})) {
    levels = *BuildLodChain(terrain, horizon, plan, {});
  }
  Dem dem;
  Terrain terrain;
  Horizon horizon;
  std::vector<Lod> levels;
};

// Whether some side of a triangle has posts on both sides of a line: by all lines and all sides.
bool IsCrossed(const Dem& dem, const Lod& level) {
  const auto between = [](int p, int q, int posts, int depth) {
    for (int i = std::min(p, q) + 1; i < std::max(p, q); ++i) {
      if (PartGrid::IsCutAt(i, posts, depth)) return true;
    }
    return false;
  };
  for (const Triangle& t : level.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = t[k];
      const VertexId b = t[(k + 1) % 3];
      if (between(dem.Column(a), dem.Column(b), dem.columns, level.parts.columns) ||
          between(dem.Row(a), dem.Row(b), dem.rows, level.parts.rows)) {
        return true;
      }
    }
  }
  return false;
}

TEST(LodChainParts, NoEdgeCrossesALineAndLevelsAreSound) {
  std::mt19937 random(1868);
  std::map<int, int> depths;
  for (int i = 0; i < Rounds(10); ++i) {
    Dem dem =
        FractalDem(129 + static_cast<int>(random() % 20), 2000,
                   60 + static_cast<int>(random() % 80), static_cast<std::uint32_t>(random()));
    // A hole, perhaps over a line, perhaps at a side.
    const auto x = static_cast<std::int32_t>(random() % 120);
    const auto y = static_cast<std::int32_t>(random() % 120);
    for (std::int32_t r = y; i % 2 == 0 && r < std::min(y + 9, dem.rows); ++r) {
      for (std::int32_t c = x; c < std::min(x + 14, dem.columns); ++c) {
        dem.heights[static_cast<std::size_t>(r * dem.columns + c)] = kNoHeight;
      }
    }
    LodPlan plan;
    plan.part_triangles = 100 << 2 * (i % 3);
    if (i % 3 == 0) plan.triangles = {9000, 4000, 1500, 500, 100, 20};
    const CutChain chain(dem, plan);
    for (std::size_t n = 0; n < chain.levels.size(); ++n) {
      const Lod& level = chain.levels[n];
      const std::vector<std::int32_t>* finer = n == 0 ? nullptr : &chain.levels[n - 1].kept;
      ASSERT_EQ(FaultOfLevel(chain.terrain, chain.horizon, level, finer), "");
      ASSERT_FALSE(IsCrossed(dem, level)) << "DEM " << i << " level " << n;
      ++depths[level.parts.columns];
      if (n == 0) continue;
      EXPECT_LE(level.parts.columns, chain.levels[n - 1].parts.columns);
      EXPECT_LE(level.parts.rows, chain.levels[n - 1].parts.rows);
    }
  }
  EXPECT_GE(depths.size(), 3U);  // cut not at all, once and twice
}

TEST(LodChainParts, ALevelIsCutAsDeepAsItsTrianglesAskAndNoDeeper) {
  const Dem dem = FractalDem(GridSide(387), 2000, 100, 7);
  LodPlan plan;
  plan.part_triangles = 1500;
  plan.max_error_m = 30;
  double share = 0.2;  // of all triangles, by which sides are thinned
  for (const Lod& level : CutChain(dem, plan).levels) {
    const auto triangles = std::ssize(level.mesh.triangles);
    const int most = SidePartDepth(dem.columns, SidePosts::ShareOf(share == 0.2 ? 1 : share));
    EXPECT_EQ(level.parts, PartDepthFor(triangles, 1500, {most, most})) << triangles;
    share *= 0.4;
  }
  plan.part_triangles = 0;
  for (const Lod& level : CutChain(dem, plan).levels) EXPECT_EQ(level.parts, PartDepth{});
}

}  // namespace
}  // namespace farhorizon
