#include "core/horizon/sweep/sweep_order.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <stop_token>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

bool ComesBefore(const Dem& dem, VertexId a, VertexId b) {
  const std::int32_t height_a = dem.heights[static_cast<std::size_t>(a)];
  const std::int32_t height_b = dem.heights[static_cast<std::size_t>(b)];
  return height_a != height_b ? height_a > height_b : a < b;
}

void ExpectTheOrder(const Terrain& terrain, const SweepOrder& order) {
  const Dem& dem = terrain.dem();
  std::vector<VertexId> vertices;
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    std::vector<VertexId> before;
    bool some_after = false;
    for (const VertexId n : terrain.NeighboursOf(v)) {
      if (ComesBefore(dem, n, v)) {
        before.push_back(n);
      } else {
        some_after = true;
      }
    }
    if (terrain.IsVertex(v)) vertices.push_back(v);

    const SweepOrder::NeighbourOrder& neighbours =
        order.neighbour_orders[static_cast<std::size_t>(v)];
    std::vector<VertexId> found;
    for (std::size_t i = 0; i < order.offsets.size(); ++i) {
      if ((neighbours.before >> i & 1U) != 0) found.push_back(v + order.offsets[i]);
    }
    std::sort(before.begin(), before.end());
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, before) << "post " << v;
    ASSERT_EQ(neighbours.some_after, some_after) << "post " << v;
  }
  std::sort(vertices.begin(), vertices.end(),
            [&dem](VertexId a, VertexId b) { return ComesBefore(dem, a, b); });
  ASSERT_EQ(order.vertices, vertices);
}

// Heights of few values are counted, others are sorted; random terrains have both.
TEST(OrderOfSweep, IsTheDefinitionAtAnyNumberOfThreads) {
  std::mt19937 random(5);
  for (int round = 0; round < Rounds(2000); ++round) {
    Dem dem = AnyRandomDem(2, 9, random);
    if (round % 3 == 0) {
      for (std::int32_t& height : dem.heights) {
        if (height != kNoHeight) height *= 1000;
      }
    }
    const Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    SCOPED_TRACE(DrawAscii(dem));
    for (const int threads : {1, 3}) {
      ExpectTheOrder(*terrain, *OrderOfSweep(*terrain, threads, {}));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(OrderOfSweep, ReadsRowsInManyBatches) {
  std::mt19937 random(6);
  const Dem dem = AnyRandomDem(70, 90, random);
  const Result<Terrain> terrain = Terrain::Build(dem);
  ASSERT_TRUE(terrain);
  ExpectTheOrder(*terrain, *OrderOfSweep(*terrain, 4, {}));
}

TEST(OrderOfSweep, StopsWhenAskedTo) {
  const Dem dem = AsciiDem("1 2\n3 4");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(OrderOfSweep(*Terrain::Build(dem), 1, {{}, stop.get_token()}).has_value());
}

}  // namespace
}  // namespace farhorizon
