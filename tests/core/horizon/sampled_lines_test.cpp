// Sampled lines against the exact set: an edge that alone is highest over one line belongs to the
// horizon (oracles O11 and O12 of tests/oracles/README.md: tools that march along directions, and
// z-buffers).
#include <algorithm>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/horizon/lines/highest_over_line.h"
#include "tests/support/effort.h"
#include "tests/support/matchers.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

struct Direction2i {
  std::int32_t dc;
  std::int32_t dr;
};

// Every direction in integers up to `size`, once.
std::vector<Direction2i> DirectionsUpTo(std::int32_t size) {
  std::vector<Direction2i> directions;
  for (std::int32_t dr = 0; dr <= size; ++dr) {
    for (std::int32_t dc = -size; dc <= size; ++dc) {
      if (dr == 0 && dc != 1) continue;
      if (std::gcd(dc, dr) == 1) directions.push_back({dc, dr});
    }
  }
  return directions;
}

// The segment that alone is highest over the line; nullopt where there are several.
std::optional<std::size_t> OnlyHighest(const std::vector<Segment>& segments, const PlanLine& line) {
  std::optional<ExactHeight> highest;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const std::optional<ExactHeight> height = HeightOver(segments[i], line);
    if (!height) continue;
    const int above = highest ? Compare(*height, *highest) : 1;
    if (above == 0) found.reset();
    if (above <= 0) continue;
    highest = height;
    found = i;
  }
  return found;
}

// The edges that a z-buffer of these directions finds, lines being half a post apart.
std::set<std::size_t> ZBuffer(const Terrain& terrain, const std::vector<Segment>& segments,
                              const std::vector<Direction2i>& directions) {
  std::set<std::size_t> found;
  const std::int32_t columns = terrain.dem().columns;
  const std::int32_t rows = terrain.dem().rows;
  for (const Direction2i d : directions) {
    // Lines start at a row of half posts, or at a column: whichever the direction crosses steeply.
    const bool along_row = d.dr >= std::abs(d.dc);
    const std::int32_t reach = 2 * std::max(columns, rows);
    for (std::int32_t i = -reach; i <= 2 * reach; ++i) {
      const PlanLine line =
          along_row ? PlanLine{i, rows | 1, d.dc, d.dr} : PlanLine{columns | 1, i, d.dc, d.dr};
      const std::optional<std::size_t> only = OnlyHighest(segments, line);
      if (only) found.insert(*only);
    }
  }
  return found;
}

std::vector<Edge> SampledEdges(const Horizon& horizon) {
  std::vector<Edge> edges;
  for (const HorizonEdge& e : horizon.edges) edges.push_back(e.edge);
  return edges;
}

// O12 (tests/oracles/README.md). On a real DEM 2880 directions miss 0.7 percent; a small one needs
// fewer.
TEST(ZBuffer, FindsOnlyEdgesOfTheHorizonAndMissesFewerWithMoreDirections) {
  const Dem dem = FractalDem(25, 600, 100, 21);
  const Terrain terrain = *Terrain::Build(dem);
  const std::vector<Edge> horizon = SampledEdges(*FindHorizon(terrain, {}, {}));
  const std::vector<Edge> edges = terrain.Edges();
  const std::vector<Segment> segments = SegmentsOf(terrain, edges);
  double missed_before = 1;
  for (const std::int32_t size : {1, 4, 20}) {
    const std::set<std::size_t> found = ZBuffer(terrain, segments, DirectionsUpTo(size));
    for (const std::size_t i : found) {
      ASSERT_TRUE(std::binary_search(horizon.begin(), horizon.end(), edges[i]))
          << edges[i].a << '-' << edges[i].b;
    }
    const double missed =
        1 - static_cast<double>(found.size()) / static_cast<double>(horizon.size());
    EXPECT_LT(missed, missed_before) << size;
    missed_before = missed;
  }
  EXPECT_LT(missed_before, 0.15);
}

// O11. Along a line through a post that is above all other ground of the line, r.horizon finds no
// horizon above the post at either azimuth. Edges of the horizon end at such a post.
void ExpectEdgesAtEveryPostAboveItsLine(const Dem& dem) {
  const Terrain terrain = *Terrain::Build(dem);
  std::set<VertexId> ends;
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  for (const HorizonEdge& e : horizon.edges) {
    ends.insert(e.edge.a);
    ends.insert(e.edge.b);
  }
  const std::vector<Edge> edges = terrain.Edges();
  const std::vector<Segment> segments = SegmentsOf(terrain, edges);
  int above = 0;
  for (const Direction2i d : DirectionsUpTo(3)) {
    for (VertexId v = 0; v < terrain.post_count(); ++v) {
      if (!terrain.IsVertex(v)) continue;
      const Point3i p = terrain.Point(v);
      const PlanLine line{2 * p.x, 2 * p.y, d.dc, d.dr};
      const bool alone = std::none_of(edges.begin(), edges.end(), [&](const Edge& e) {
        const bool at_post = e.a == v || e.b == v;
        const Point3i other = terrain.Point(e.a == v ? e.b : e.a);
        if (at_post) return other.z >= p.z && HeightOver({other, other}, line).has_value();
        const std::optional<ExactHeight> height =
            HeightOver({terrain.Point(e.a), terrain.Point(e.b)}, line);
        return height && Compare(*height, {p.z, 1}) >= 0;
      });
      if (!alone) continue;
      ++above;
      ASSERT_TRUE(ends.contains(v)) << p.x << ' ' << p.y << " along " << d.dc << ' ' << d.dr;
    }
  }
  EXPECT_GT(above, 20);
}

TEST(PostsAboveTheirLines, AreEndsOfHorizonEdgesOnMountains) {
  for (const int roughness : {60, 100, 140}) {
    ExpectEdgesAtEveryPostAboveItsLine(
        FractalDem(17, 500, roughness, static_cast<std::uint32_t>(roughness)));
  }
}

TEST(PostsAboveTheirLines, AreEndsOfHorizonEdgesOnWhiteNoise) {
  std::mt19937 random(22);
  for (int round = 0; round < 4; ++round) {
    ExpectEdgesAtEveryPostAboveItsLine(
        RandomDem({.columns = 12, .rows = 13, .max_height = 400}, random));
  }
}

}  // namespace
}  // namespace farhorizon
