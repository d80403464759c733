#include "core/horizon/join_horizons.h"

#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/io/dem/read_dem.h"
#include "tests/oracles/horizon_brute_force.h"
#include "tests/support/effort.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

using Named = std::set<std::array<std::int32_t, 6>>;

Named PostNames(const std::vector<Segment>& segments) {
  Named names;
  for (const Segment& s : segments) names.insert({s.a.x, s.a.y, s.a.z, s.b.x, s.b.y, s.b.z});
  return names;
}

std::vector<Segment> SegmentsOfEdges(const Terrain& terrain, const std::vector<Edge>& edges) {
  std::vector<Segment> segments;
  for (const Edge& e : edges) segments.push_back({terrain.Point(e.a), terrain.Point(e.b)});
  return segments;
}

std::vector<Segment> Join(const std::vector<Segment>& a, const std::vector<Segment>& b,
                          const Dem& dem) {
  return *JoinHorizons(a, b, dem.columns, dem.rows, {});
}

std::vector<Segment> SomeSegments(int count, int side, int max_height, std::mt19937& random) {
  const auto below = [&](int bound) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(bound));
  };
  std::vector<Segment> segments;
  while (static_cast<int>(segments.size()) < count) {
    const Segment s{{below(side), below(side), below(max_height + 1)},
                    {below(side), below(side), below(max_height + 1)}};
    if (s.a.x != s.b.x || s.a.y != s.b.y) segments.push_back(s);
  }
  return segments;
}

TEST(FindHorizonSegments, KeepsWhatTheDefinitionKeeps) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(300); ++round) {
    const std::vector<Segment> set = SomeSegments(3 + round % 9, 6, 1 + round % 4, random);
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < set.size(); ++i) {
      std::vector<Segment> others = set;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      if (LineOfSightByBruteForce(set[i], others, Ties::kPass)) wanted.push_back(i);
    }
    EXPECT_EQ(*FindHorizonSegments(set, 6, 6, {}), wanted) << "round " << round;
  }
}

TEST(JoinHorizons, TheHorizonOfAWholeIsThatOfItsPartsHorizons) {
  std::mt19937 random(2);
  for (int round = 0; round < Rounds(600); ++round) {
    const std::vector<Segment> whole = SomeSegments(4 + round % 30, 9, 1 + round % 9, random);
    std::vector<Segment> a;
    std::vector<Segment> b;
    for (const Segment& s : whole) {
      const auto which = random() % 5;  // some in both
      if (which < 3) a.push_back(s);
      if (which > 1) b.push_back(s);
    }
    const auto horizon = [](const std::vector<Segment>& set) {
      return *JoinHorizons(set, {}, 9, 9, {});
    };
    EXPECT_EQ(PostNames(*JoinHorizons(horizon(a), horizon(b), 9, 9, {})), PostNames(horizon(whole)))
        << "round " << round;
  }
}

// The horizon of a terrain from n x n tiles that share the posts on their seams, each swept by
// itself; creases of the whole only.
Named HorizonByTiles(const Dem& dem, std::int32_t n) {
  const Terrain whole = *Terrain::Build(dem);
  std::vector<Segment> joined;
  const auto cut = [n](std::int32_t posts, std::int32_t i) { return i * (posts - 1) / n; };
  for (std::int32_t i = 0; i < n * n; ++i) {
    const std::int32_t left = cut(dem.columns, i % n);
    const std::int32_t top = cut(dem.rows, i / n);
    const std::int32_t right = cut(dem.columns, i % n + 1);
    const std::int32_t bottom = cut(dem.rows, i / n + 1);
    Dem tile = dem;
    tile.columns = right - left + 1;
    tile.rows = bottom - top + 1;
    tile.heights.clear();
    for (std::int32_t r = top; r <= bottom; ++r) {
      const auto row = dem.heights.begin() + std::ptrdiff_t{r} * dem.columns;
      tile.heights.insert(tile.heights.end(), row + left, row + right + 1);
    }
    Result<Terrain> terrain = Terrain::Build(tile);
    if (!terrain) continue;  // a tile of nothing but holes
    std::vector<Segment> found;
    const Horizon horizon = *FindHorizon(*terrain, {}, {});
    for (const HorizonEdge& h : horizon.edges) {
      Segment s{terrain->Point(h.edge.a), terrain->Point(h.edge.b)};
      for (Point3i* p : {&s.a, &s.b}) *p = {p->x + left, p->y + top, p->z};
      found.push_back(s);
    }
    joined = Join(joined, found, dem);
  }
  const Named creases = PostNames(SegmentsOfEdges(whole, CreasesOf(MeshOf(whole))));
  Named kept;
  for (const auto& name : PostNames(joined)) {
    if (creases.count(name) > 0) kept.insert(name);
  }
  return kept;
}

Named HorizonAtOnce(const Dem& dem) {
  const Terrain terrain = *Terrain::Build(dem);
  std::vector<Edge> edges;
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  for (const HorizonEdge& h : horizon.edges) edges.push_back(h.edge);
  return PostNames(SegmentsOfEdges(terrain, edges));
}

TEST(JoinHorizons, TilesSweptApartGiveTheHorizonOfTheWhole) {
  std::mt19937 random(3);
  for (int round = 0; round < Rounds(60); ++round) {
    const Dem dem = AnyRandomDem(9, 21, random);
    if (!Terrain::Build(dem)) continue;
    const Named wanted = HorizonAtOnce(dem);
    EXPECT_EQ(HorizonByTiles(dem, 2), wanted) << "round " << round;
    EXPECT_EQ(HorizonByTiles(dem, 4), wanted) << "round " << round;
  }
}

TEST(JoinHorizons, RealDemsCutIntoTilesToo) {
  for (const char* name : {"gabilan_65.tif", "sthelens_crater_129.tif", "ontario_dted0_121.tif"}) {
    const std::filesystem::path path = std::filesystem::path(FARHORIZON_DEM_DIR) / name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << name << " in FARHORIZON_DEM_DIR";
    const Dem dem = *ReadDem(path, {});
    const Named wanted = HorizonAtOnce(dem);
    EXPECT_EQ(HorizonByTiles(dem, 2), wanted) << name;
    EXPECT_EQ(HorizonByTiles(dem, 4), wanted) << name;
  }
}

TEST(FindHorizonSegments, StopsWhenAskedTo) {
  std::mt19937 random(4);
  const std::vector<Segment> segments = SomeSegments(10, 9, 9, random);
  std::stop_source source;
  source.request_stop();
  auto stopped = FindHorizonSegments(segments, 9, 9, {.stop = source.get_token()});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace farhorizon
