// The order of the sweep, and for each vertex which of its neighbours come before it: all that can
// be known of a vertex by itself, so that the sweep (hull_sweep.h) has less to do one after
// another.
#include "core/horizon/sweep/sweep_order.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/base/parallel_for.h"

namespace farhorizon {

namespace {

SweepOrder::NeighbourOrder NeighbourOrderOf(const Terrain& terrain, VertexId v) {
  const std::vector<std::int32_t>& heights = terrain.dem().heights;
  const std::int32_t columns = terrain.dem().columns;
  const std::int32_t height = heights[static_cast<std::size_t>(v)];
  SweepOrder::NeighbourOrder neighbours;
  for (const VertexId n : terrain.NeighboursOf(v)) {
    const std::int32_t of_n = heights[static_cast<std::size_t>(n)];
    if (of_n < height || (of_n == height && n > v)) {
      neighbours.some_after = true;
      continue;
    }
    // In a DEM of two columns, the neighbour to the right has the number of the post one row down
    // and one column to the left, which is no post: either bit means the same number.
    const std::int32_t down = n - v > 1 ? 1 : n - v < -1 ? -1 : 0;
    const std::int32_t right = n - v - down * columns;
    neighbours.before |= static_cast<std::uint16_t>(1U << (3 * (down + 1) + right + 1));
  }
  return neighbours;
}

// The vertices by falling height, then by rising number. Heights usually take few values; then they
// are counted, which is many times faster than sorting.
std::vector<VertexId> FromSummitDown(const std::vector<std::int32_t>& heights,
                                     const std::vector<SweepOrder::NeighbourOrder>& neighbours) {
  std::vector<VertexId> order;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  std::int64_t most = std::numeric_limits<std::int64_t>::min();
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (neighbours[i].before == 0 && !neighbours[i].some_after) continue;
    order.push_back(static_cast<VertexId>(i));
    least = std::min<std::int64_t>(least, heights[i]);
    most = std::max<std::int64_t>(most, heights[i]);
  }
  if (most - least > 4 * static_cast<std::int64_t>(order.size())) {
    std::sort(order.begin(), order.end(), [&heights](VertexId a, VertexId b) {
      const std::int32_t height_a = heights[static_cast<std::size_t>(a)];
      const std::int32_t height_b = heights[static_cast<std::size_t>(b)];
      return height_a != height_b ? height_a > height_b : a < b;
    });
    return order;
  }
  const auto below_top = [&](VertexId v) {
    return static_cast<std::size_t>(most - heights[static_cast<std::size_t>(v)]);
  };
  std::vector<std::size_t> begins(static_cast<std::size_t>(most - least) + 2);
  for (const VertexId v : order) ++begins[below_top(v) + 1];
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<VertexId> sorted(order.size());
  for (const VertexId v : order) sorted[begins[below_top(v)]++] = v;
  return sorted;
}

}  // namespace

std::optional<SweepOrder> OrderOfSweep(const Terrain& terrain, int threads,
                                       const RunControl& control) {
  const auto columns = static_cast<std::size_t>(terrain.dem().columns);
  SweepOrder order;
  for (std::int32_t i = 0; i < 9; ++i) {
    order.offsets[static_cast<std::size_t>(i)] = (i / 3 - 1) * terrain.dem().columns + i % 3 - 1;
  }
  order.neighbour_orders.resize(terrain.dem().heights.size());
  const auto find_neighbours = [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
    for (std::size_t v = begin * columns; v < end * columns; ++v) {
      order.neighbour_orders[v] = NeighbourOrderOf(terrain, static_cast<VertexId>(v));
    }
  };
  constexpr std::size_t kRows = 32;
  if (!ParallelForBatches(static_cast<std::size_t>(terrain.dem().rows), kRows, threads,
                          Stage::kSweep, control, find_neighbours)) {
    return std::nullopt;
  }
  order.vertices = FromSummitDown(terrain.dem().heights, order.neighbour_orders);
  return order;
}

}  // namespace farhorizon
