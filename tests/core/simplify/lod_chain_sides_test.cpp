// Two tiles that are made apart agree on the side that they share.
#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/simplify/lod_chain.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/level_checks.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

// Columns first ... first + columns - 1 of a DEM, or rows where `by_row`.
Dem Crop(const Dem& whole, std::int32_t first, std::int32_t count, bool by_row) {
  Dem dem = whole;
  dem.heights.clear();
  (by_row ? dem.rows : dem.columns) = count;
  for (std::int32_t r = 0; r < dem.rows; ++r) {
    for (std::int32_t c = 0; c < dem.columns; ++c) {
      const std::int32_t x = by_row ? c : c + first;
      const std::int32_t y = by_row ? r + first : r;
      dem.heights.push_back(whole.heights[static_cast<std::size_t>(y * whole.columns + x)]);
    }
  }
  return dem;
}

struct SidePost {
  std::int32_t place;
  double height_m;
  friend bool operator==(const SidePost&, const SidePost&) = default;
};

struct Tile {
  Tile(const Dem& of, const LodPlan& plan)
      : dem(of), terrain(*Terrain::Build(dem)), horizon(*FindHorizon(terrain, {}, {})) {
    levels = *BuildLodChain(terrain, horizon, plan, {});
  }
  // A level's posts on one column, or row.
  [[nodiscard]] std::vector<SidePost> On(std::size_t level, std::int32_t line, bool by_row) const {
    std::vector<SidePost> posts;
    const PostMesh& mesh = levels[level].mesh;
    for (std::size_t i = 0; i < mesh.posts.size(); ++i) {
      const std::int32_t column = dem.Column(mesh.posts[i]);
      const std::int32_t row = dem.Row(mesh.posts[i]);
      if ((by_row ? row : column) != line) continue;
      posts.push_back({by_row ? column : row, mesh.heights_m[i]});
    }
    return posts;
  }
  Dem dem;
  Terrain terrain;
  Horizon horizon;
  std::vector<Lod> levels;
};

struct Agreement {
  int levels = 0;
  std::int64_t fitted = 0;  // posts at other heights than the DEM's
  std::int64_t kept = 0;
  std::int64_t posts = 0;
};

void ExpectOneSide(const Dem& whole, bool by_row, const LodPlan& plan, Agreement& agreement) {
  const std::int32_t n = (by_row ? whole.rows : whole.columns) / 2 + 1;
  const Tile west(Crop(whole, 0, n, by_row), plan);
  const Tile east(Crop(whole, n - 1, n, by_row), plan);
  const std::size_t count = std::min(west.levels.size(), east.levels.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<SidePost> side = west.On(i, n - 1, by_row);
    ASSERT_EQ(side, east.On(i, 0, by_row)) << "level " << i << "\n" << DrawAscii(whole);
    ++agreement.levels;
    agreement.kept += std::ssize(side);
    agreement.posts += by_row ? whole.columns : whole.rows;
    for (const SidePost& post : side) {
      const std::int32_t v =
          by_row ? (n - 1) * whole.columns + post.place : post.place * whole.columns + n - 1;
      agreement.fitted += whole.HeightM(v) != post.height_m ? 1 : 0;
    }
  }
}

LodPlan ByTriangles(const Dem& whole) {
  LodPlan plan;
  const std::int64_t full = std::int64_t{whole.columns} * whole.rows;
  for (const int part : {1, 4, 10, 25, 60, 150, 400}) plan.triangles.push_back(full / part + 1);
  return plan;
}

Dem RoughWhole(std::int32_t side, std::mt19937& random) {
  if (random() % 3 == 0) {
    RandomTerrain noise;
    noise.columns = side;
    noise.rows = side;
    noise.max_height = random() % 2 == 0 ? 2 : 1000;
    return RandomDem(noise, random);
  }
  return FractalDem(side, 2000, 60 + static_cast<int>(random() % 80),
                    static_cast<std::uint32_t>(random()));
}

TEST(LodChainSides, TwoNeighboursAgreeOnPostsAndHeightsByTriangles) {
  std::mt19937 random(1);
  Agreement agreement;
  for (int round = 0; round < Rounds(40); ++round) {
    const Dem whole = RoughWhole(2 * (8 + static_cast<std::int32_t>(random() % 14)) + 1, random);
    SCOPED_TRACE(round);
    ExpectOneSide(whole, round % 2 == 0, ByTriangles(whole), agreement);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(agreement.levels, Rounds(230));
  EXPECT_GT(agreement.fitted, Rounds(200));
  EXPECT_LT(agreement.kept, agreement.posts * 3 / 4);
}

TEST(LodChainSides, TwoNeighboursAgreeOnPostsAndHeightsBySize) {
  std::mt19937 random(2);
  Agreement agreement;
  for (int round = 0; round < Rounds(3); ++round) {
    const Dem whole = RoughWhole(2 * GridSide(90) + 1, random);
    LodPlan plan;
    plan.max_error_m = 2;
    plan.column_bend = 1e-3;
    SCOPED_TRACE(round);
    ExpectOneSide(whole, round % 2 == 0, plan, agreement);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(agreement.levels, Rounds(3));
  EXPECT_GT(agreement.fitted, Rounds(10));
}

TEST(LodChainSides, HolesAcrossTheSideMakeNoDifference) {
  std::mt19937 random(3);
  Agreement agreement;
  for (int round = 0; round < Rounds(40); ++round) {
    const std::int32_t side = 2 * (8 + static_cast<std::int32_t>(random() % 14)) + 1;
    Dem whole = RoughWhole(side, random);
    const bool by_row = round % 2 == 0;
    // Rectangles without data that reach over the shared column on both sides of it, alike.
    for (int hole = 0; hole < 3; ++hole) {
      const auto from = static_cast<std::int32_t>(random() % static_cast<unsigned>(side));
      const auto length = static_cast<std::int32_t>(1 + random() % 4);
      const auto reach = static_cast<std::int32_t>(1 + random() % 4);
      for (std::int32_t k = from; k < std::min(side, from + length); ++k) {
        for (std::int32_t x = side / 2 - reach; x <= side / 2 + reach; ++x) {
          whole.heights[static_cast<std::size_t>(by_row ? x * side + k : k * side + x)] = kNoHeight;
        }
      }
    }
    SCOPED_TRACE(round);
    ExpectOneSide(whole, by_row, ByTriangles(whole), agreement);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(agreement.levels, Rounds(230));
}

// Rows, or columns, of a tile's line at which its outline turns, or fans meet, or that it lacks.
std::set<std::int32_t> CornersOn(const Tile& tile, std::int32_t line, bool by_row) {
  std::map<VertexId, std::vector<Edge>> at;
  for (const Edge& edge : OutlineOf(tile.terrain.Triangles())) {
    at[edge.a].push_back(edge);
    at[edge.b].push_back(edge);
  }
  std::set<std::int32_t> corners;
  for (VertexId v = 0; v < tile.terrain.post_count(); ++v) {
    if (!tile.terrain.IsVertex(v) && (by_row ? tile.dem.Row(v) : tile.dem.Column(v)) == line) {
      corners.insert(by_row ? tile.dem.Column(v) : tile.dem.Row(v));
    }
  }
  for (const auto& [v, edges] : at) {
    const auto on = [&](VertexId u) {
      return (by_row ? tile.dem.Row(u) : tile.dem.Column(u)) == line;
    };
    if (!on(v)) continue;
    bool straight = edges.size() == 2;
    for (const Edge& edge : edges) straight = straight && on(edge.a) && on(edge.b);
    if (!straight) corners.insert(by_row ? tile.dem.Column(v) : tile.dem.Row(v));
  }
  return corners;
}

TEST(LodChainSides, AHoleBesideTheSideAddsNothingButItsOwnCorners) {
  std::mt19937 random(5);
  std::int64_t added = 0;
  std::int64_t shared = 0;
  for (int round = 0; round < Rounds(40); ++round) {
    const std::int32_t side = 2 * (8 + static_cast<std::int32_t>(random() % 10)) + 1;
    Dem whole = RoughWhole(side, random);
    const bool by_row = round % 2 == 0;
    const std::int32_t middle = side / 2;
    for (int hole = 0; hole < 2; ++hole) {  // one beside the shared line on either side of it
      const auto from = static_cast<std::int32_t>(2 + random() % static_cast<unsigned>(side - 5));
      const std::int32_t x = hole == 0 ? middle - 1 : middle + 1;
      for (std::int32_t k = from; k < from + 1 + round % 3; ++k) {
        whole.heights[static_cast<std::size_t>(by_row ? x * side + k : k * side + x)] = kNoHeight;
      }
    }
    const LodPlan plan = ByTriangles(whole);
    const Tile west(Crop(whole, 0, middle + 1, by_row), plan);
    const Tile east(Crop(whole, middle, middle + 1, by_row), plan);
    const std::set<std::int32_t> west_corners = CornersOn(west, middle, by_row);
    const std::set<std::int32_t> east_corners = CornersOn(east, 0, by_row);
    for (std::size_t i = 0; i < plan.triangles.size(); ++i) {
      const auto without = [&](std::vector<SidePost> posts) {
        const auto all = posts.size();
        std::erase_if(posts, [&](const SidePost& post) {
          return west_corners.count(post.place) + east_corners.count(post.place) > 0;
        });
        added += static_cast<std::int64_t>(all - posts.size());
        return posts;
      };
      const std::vector<SidePost> posts = without(west.On(i, middle, by_row));
      ASSERT_EQ(posts, without(east.On(i, 0, by_row))) << "level " << i << "\n" << DrawAscii(whole);
      shared += std::ssize(posts);
    }
  }
  EXPECT_GT(added, Rounds(100));
  EXPECT_GT(shared, Rounds(700));
}

// A post that should go cannot be collapsed where its ring would turn over. A tile with the same
// side that is level behind it hardly has such posts: it must not have others.
TEST(LodChainSides, NoPostOfASideIsStuck) {
  std::mt19937 random(4);
  std::int64_t levels = 0;
  for (int round = 0; round < Rounds(1000); ++round) {
    const std::int32_t side = 2 * (3 + static_cast<std::int32_t>(random() % 6)) + 1;
    const Dem whole = RoughWhole(side, random);
    const LodPlan plan = ByTriangles(whole);
    const std::int32_t n = side / 2 + 1;
    const Dem rough = Crop(whole, 0, n, false);
    Dem smooth = rough;
    for (VertexId v = 0; v < static_cast<VertexId>(smooth.heights.size()); ++v) {
      if (smooth.Column(v) + 1 < n) smooth.heights[static_cast<std::size_t>(v)] = 0;
    }
    const Tile stuck(rough, plan);
    const Tile free(smooth, plan);
    for (std::size_t i = 0; i < plan.triangles.size(); ++i) {
      ASSERT_EQ(stuck.On(i, n - 1, false), free.On(i, n - 1, false)) << "level " << i << "\n"
                                                                     << DrawAscii(rough);
      ++levels;
    }
  }
  EXPECT_EQ(levels, Rounds(1000) * 7);
}

// One tile is cut, the other, of less ground, is not.
TEST(LodChainSides, TwoNeighboursAgreeHoweverDeepEitherIsCut) {
  const Dem whole = FractalDem(193, 2000, 100, 3);
  LodPlan plan;
  plan.part_triangles = 1000;
  const Tile west(Crop(whole, 0, 160, false), plan);
  plan.part_triangles = 0;
  const Tile east(Crop(whole, 159, 34, false), plan);
  EXPECT_GT(west.levels[0].parts.rows, 0);
  EXPECT_GT(west.levels[1].parts.rows, 0);
  for (std::size_t i = 0; i < std::min(west.levels.size(), east.levels.size()); ++i) {
    EXPECT_EQ(west.On(i, 159, false), east.On(i, 0, false)) << "level " << i;
  }
}

}  // namespace
}  // namespace farhorizon
