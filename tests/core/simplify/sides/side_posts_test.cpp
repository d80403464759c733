#include "core/simplify/sides/side_posts.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "core/simplify/sides/ranking.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/small_terrains.h"

namespace farhorizon {
namespace {

std::vector<VertexId> PostsAt(const SidePosts& sides, double share) {
  std::vector<VertexId> posts;
  for (const SidePosts::Height& side : sides.At(share)) posts.push_back(side.post);
  std::sort(posts.begin(), posts.end());
  posts.erase(std::unique(posts.begin(), posts.end()), posts.end());
  return posts;
}

TEST(SidePosts, OfShareOneAreAllWithDataAtTheirOwnHeights) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(300); ++round) {
    const Dem dem = AnySmallDemInQuanta(12, random);
    const Terrain terrain = *Terrain::Build(dem);
    const SidePosts sides(terrain);
    std::vector<VertexId> wanted;
    for (VertexId v = 0; v < terrain.post_count(); ++v) {
      const bool side = dem.Column(v) == 0 || dem.Row(v) == 0 || dem.Column(v) == dem.columns - 1 ||
                        dem.Row(v) == dem.rows - 1;
      if (side && dem.HasData(v)) wanted.push_back(v);
    }
    ASSERT_EQ(PostsAt(sides, 1), wanted) << DrawAscii(dem);
    for (const SidePosts::Height& side : sides.At(1)) {
      ASSERT_EQ(side.height_m, dem.HeightM(side.post));
    }
  }
}

TEST(SidePosts, GoByShareAndNeverAtTheEndsOfRuns) {
  // Runs: 9 posts, 3 and 5; the left and the right side have 3 each.
  const Dem dem = AsciiDem("1 5 2 7 3 9 4 8 1\n2 2 2 2 2 2 2 2 2\n6 1 6 . 5 1 4 2 9");
  const Terrain terrain = *Terrain::Build(dem);
  const SidePosts sides(terrain);
  const std::vector<VertexId> ends = {0, 8, 18, 20, 22, 26};
  EXPECT_EQ(PostsAt(sides, 0), ends);
  std::size_t last = ends.size();
  for (const double share : {0.2, 0.5, 0.8, 1.0}) {
    const std::vector<VertexId> posts = PostsAt(sides, share);
    EXPECT_GT(posts.size(), last) << share;
    EXPECT_TRUE(std::includes(posts.begin(), posts.end(), ends.begin(), ends.end()));
    last = posts.size();
  }
  std::map<VertexId, double> corner;
  for (const SidePosts::Height& side : sides.At(0.5)) {
    if (!corner.emplace(side.post, side.height_m).second) {
      EXPECT_EQ(corner[side.post], side.height_m);
    }
    if (std::find(ends.begin(), ends.end(), side.post) != ends.end()) {
      EXPECT_EQ(side.height_m, dem.HeightM(side.post));
    }
  }
}

TEST(SidePosts, HalfOfThemStayWhereALevelHasATwentyFifthOfTheTriangles) {
  EXPECT_DOUBLE_EQ(SidePosts::ShareOf(0.04), 0.5);
  EXPECT_EQ(SidePosts::ShareOf(0.16), 1);
  EXPECT_EQ(SidePosts::ShareOf(1), 1);
  const Dem dem = AsciiDem(std::string(101, '3') + "\n" + std::string(101, '4'));
  const Terrain terrain = *Terrain::Build(dem);
  EXPECT_EQ(PostsAt(SidePosts(terrain), 0.5).size(), 2 * 51U);
}

}  // namespace
}  // namespace farhorizon
