#include "core/horizon/sweep/hull_sweep.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/geometry/union_find.h"
#include "core/horizon/find_horizon.h"
#include "core/terrain/terrain.h"
#include "tests/support/effort.h"
#include "tests/support/small_stack.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

using Corners = std::vector<Point2i>;

Corners SortedHull(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

// The merged hulls of the ground at or above a height by the definition: hulls of connected ground,
// merged as long as two of them meet.
std::set<Corners> HullsByDefinition(const Terrain& terrain, std::int32_t height) {
  const Dem& dem = terrain.dem();
  const auto is_above = [&](VertexId v) {
    return terrain.IsVertex(v) && dem.heights[static_cast<std::size_t>(v)] >= height;
  };
  std::vector<std::int32_t> roots(dem.heights.size());
  std::iota(roots.begin(), roots.end(), 0);
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (!is_above(v)) continue;
    for (const VertexId n : terrain.NeighboursOf(v)) {
      if (is_above(n)) roots[static_cast<std::size_t>(FindRoot(roots, n))] = FindRoot(roots, v);
    }
  }
  std::vector<Corners> posts(dem.heights.size());
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (!is_above(v)) continue;
    posts[static_cast<std::size_t>(FindRoot(roots, v))].push_back({dem.Column(v), dem.Row(v)});
  }
  std::vector<ConvexPolygon> hulls;
  for (Corners& of_one : posts) {
    if (!of_one.empty()) hulls.push_back(ConvexPolygon::HullOf(of_one));
  }
  for (std::size_t i = 0; i < hulls.size();) {
    const auto other = std::find_if(hulls.begin(), hulls.end(), [&](const ConvexPolygon& hull) {
      return &hull != &hulls[i] && hull.Meets(hulls[i]);
    });
    if (other == hulls.end()) {
      ++i;
      continue;
    }
    Corners both = hulls[i].corners();
    both.insert(both.end(), other->corners().begin(), other->corners().end());
    *other = ConvexPolygon::HullOf(both);
    hulls.erase(hulls.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;
  }
  std::set<Corners> all;
  for (const ConvexPolygon& hull : hulls) all.insert(SortedHull(hull.corners()));
  return all;
}

std::set<Corners> HullsOf(const HullScene& scene) {
  std::set<Corners> all;
  for (const ConvexPolygon& hull : scene.hulls()) all.insert(SortedHull(hull.corners()));
  return all;
}

TEST(HullSweep, ReplaysTheMergedHullsFromEveryState) {
  std::mt19937 random(31);
  for (int round = 0; round < Rounds(60); ++round) {
    const Dem dem = AnyRandomDem(3, 13, random);
    const Terrain terrain = *Terrain::Build(dem);
    const HullSweep sweep = *SweepHulls(terrain, 1, {});
    const auto height_of = [&dem](VertexId v) { return dem.heights[static_cast<std::size_t>(v)]; };
    const std::set<std::int32_t> heights(dem.heights.begin(), dem.heights.end());
    for (std::size_t state = 0; state < sweep.history.state_count(); ++state) {
      HullHistory::Replay replay(sweep.history, state);
      for (auto height = heights.rbegin(); height != heights.rend(); ++height) {
        if (*height > height_of(sweep.history.VertexAt(state)) || *height == kNoHeight) continue;
        replay.ApplyWhile([&](VertexId v) { return height_of(v) >= *height; });
        ASSERT_EQ(HullsOf(replay.scene()), HullsByDefinition(terrain, *height))
            << "round " << round << ", state " << state << ", height " << *height;
      }
    }
  }
}

TEST(HullSweep, EnclosesEachPostAtTheHeightAtWhichAHullContainsIt) {
  std::mt19937 random(32);
  for (int round = 0; round < Rounds(60); ++round) {
    const Dem dem = AnyRandomDem(3, 10, random);
    const Terrain terrain = *Terrain::Build(dem);
    const HullSweep sweep = *SweepHulls(terrain, 1, {});
    const std::set<std::int32_t> heights(dem.heights.begin(), dem.heights.end());
    for (const std::int32_t height : heights) {
      if (height == kNoHeight) continue;
      const std::set<Corners> hulls = HullsByDefinition(terrain, height);
      for (VertexId v = 0; v < terrain.post_count(); ++v) {
        const bool enclosed = std::any_of(hulls.begin(), hulls.end(), [&](Corners corners) {
          return ConvexPolygon::HullOf(corners).Contains({dem.Column(v), dem.Row(v)});
        });
        ASSERT_EQ(sweep.hulls.Occludes(v, v, height), enclosed) << "round " << round;
      }
    }
  }
}

// Level ground extends one hull post after post: no more is kept of it than where it begins.
TEST(HullSweep, KeepsLevelGroundByRuns) {
  const Dem dem = MakeDem(120, 100, [](std::int32_t, std::int32_t) { return 7; });
  const HullSweep sweep = *SweepHulls(*Terrain::Build(dem), 1, {});
  EXPECT_LE(sweep.history.record_count(), 2 + sweep.history.state_count());
}

// Ground of 0, 1 or 2 quanta: ever more small hulls, which one large hull swallows at last.
Dem NoisyPlain(std::int32_t side) {
  std::mt19937 random(33);
  return RandomDem({.columns = side, .rows = side, .max_height = 2}, random);
}

// Long teeth side by side, joined at one end, lowest there.
Dem Comb(std::int32_t side) {
  return MakeDem(side, side, [side](std::int32_t x, std::int32_t y) {
    return y == side - 1 ? 1 : x % 2 == 0 ? 2 + y % 3 + x % 5 : 0;
  });
}

// A wall that falls along its way inwards, with a ditch beside it.
Dem Spiral(std::int32_t side) {
  Dem dem = MakeDem(side, side, [](std::int32_t, std::int32_t) { return 0; });
  const auto height = [&](std::int32_t x, std::int32_t y) -> std::int32_t& {
    return dem.heights[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                       static_cast<std::size_t>(x)];
  };
  const auto is_free = [&](std::int32_t x, std::int32_t y) {
    return x >= 0 && y >= 0 && x < side && y < side && height(x, y) == 0;
  };
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t dx = 1;
  std::int32_t dy = 0;
  std::int32_t left = side * side;
  height(x, y) = left;
  for (int turns = 0; turns < 2;) {
    const bool ahead =
        is_free(x + dx, y + dy) && (is_free(x + 2 * dx, y + 2 * dy) || x + 2 * dx < 0 ||
                                    x + 2 * dx >= side || y + 2 * dy < 0 || y + 2 * dy >= side);
    if (!ahead) {
      std::tie(dx, dy) = std::pair(-dy, dx);
      ++turns;
      continue;
    }
    turns = 0;
    x += dx;
    y += dy;
    height(x, y) = --left;
  }
  return dem;
}

Dem Staircase(std::int32_t side) {
  return MakeDem(side, side, [](std::int32_t x, std::int32_t y) { return (x + 2 * y) / 5; });
}

std::vector<Dem> DeepGround(std::int32_t side) {
  return {NoisyPlain(side), Comb(side), Spiral(side), Staircase(side)};
}

TEST(HullSweep, NeedsASmallStack) {
  for (const Dem& dem : DeepGround(250)) {
    RunOnSmallStack([&dem] {
      const Terrain terrain = *Terrain::Build(dem);
      EXPECT_GT(SweepHulls(terrain, 1, {})->history.record_count(), 0u);
    });
  }
}

TEST(HullSweep, NeedsASmallStackForTheSet) {
  for (const Dem& dem : DeepGround(64)) {
    RunOnSmallStack([&dem] {
      const Terrain terrain = *Terrain::Build(dem);
      EXPECT_FALSE(FindHorizon(terrain, {}, {})->edges.empty());
    });
  }
}

TEST(HullSweepLong, NeedsASmallStackForAMillionPosts) {
  for (const Dem& dem : DeepGround(1000)) {
    RunOnSmallStack([&dem] {
      const Terrain terrain = *Terrain::Build(dem);
      Result<Horizon> horizon =
          FindHorizon(terrain, {.work_budget = 100'000'000, .approximate = true}, {});
      EXPECT_FALSE(horizon->edges.empty());
    });
  }
}

}  // namespace
}  // namespace farhorizon
