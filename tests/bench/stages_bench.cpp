// The time and memory of each stage of the adaptive engine on square cuts of a DEM, side by side
// with what sorting the heights and reading every edge once takes; medians, and how they grow.
//
//   stages_bench DEM [REPETITIONS]
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <malloc.h>
#include <new>
#include <vector>

#include "core/horizon/find_horizon.h"
#include "core/horizon/lines_of_sight/lines_of_sight.h"
#include "core/horizon/lines_of_sight/skyline_drop.h"
#include "core/horizon/sweep/candidates.h"
#include "core/horizon/sweep/hull_sweep.h"
#include "core/io/dem/read_dem.h"
#include "core/pipeline/edge_measures.h"
#include "core/terrain/terrain.h"

namespace {

// Bytes that are in use, and the most since the last reset.
std::atomic<std::int64_t> in_use{0};
std::atomic<std::int64_t> most_in_use{0};

}  // namespace

void* operator new(std::size_t size) {
  void* memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  const auto usable = static_cast<std::int64_t>(malloc_usable_size(memory));
  const std::int64_t now = in_use += usable;
  for (std::int64_t most = most_in_use; now > most;) {
    if (most_in_use.compare_exchange_weak(most, now)) break;
  }
  return memory;
}

void operator delete(void* memory) noexcept {
  in_use -= static_cast<std::int64_t>(malloc_usable_size(memory));
  std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept { operator delete(memory); }

namespace farhorizon {
namespace {

struct Cost {
  double ms = 0;          // median
  double bytes_peak = 0;  // beyond what was in use before, of the last run
};

Cost Measure(int repetitions, const std::function<void()>& work) {
  std::vector<double> times;
  Cost cost;
  for (int i = 0; i < repetitions; ++i) {
    const std::int64_t before = in_use;
    most_in_use = before;
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    times.push_back(took.count());
    cost.bytes_peak = static_cast<double>(most_in_use - before);
  }
  std::sort(times.begin(), times.end());
  cost.ms = times[times.size() / 2];
  return cost;
}

Dem Cut(const Dem& dem, std::int32_t columns, std::int32_t rows) {
  Dem cut = dem;
  cut.columns = columns;
  cut.rows = rows;
  cut.heights.clear();
  for (std::int32_t row = 0; row < rows; ++row) {
    const auto begin = dem.heights.begin() + static_cast<std::ptrdiff_t>(row) * dem.columns;
    cut.heights.insert(cut.heights.end(), begin, begin + columns);
  }
  return cut;
}

// What any sweep must do: its heights in order, and both ends of every edge.
void SortAndRead(const Terrain& terrain) {
  std::vector<std::int32_t> heights = terrain.dem().heights;
  std::sort(heights.begin(), heights.end());
  std::int64_t climbs = heights.front();
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    for (const VertexId n : terrain.NeighboursOf(v)) {
      if (n > v && terrain.Point(n).z > terrain.Point(v).z) ++climbs;
    }
  }
  volatile std::int64_t kept = climbs;
  static_cast<void>(kept);
}

struct Row {
  double posts;
  Cost whole;
};

Row Report(const Dem& dem, int repetitions) {
  const Terrain terrain = std::move(*Terrain::Build(dem));
  const double posts = static_cast<double>(dem.columns) * dem.rows;
  const Cost floor = Measure(repetitions, [&] { SortAndRead(terrain); });
  const Cost sweep = Measure(repetitions, [&] { static_cast<void>(SweepHulls(terrain, 1, {})); });
  const HullSweep swept = std::move(*SweepHulls(terrain, 1, {}));
  const Cost candidates = Measure(repetitions, [&] {
    WorkBudget any(WorkBudget::kMost);
    static_cast<void>(FindCandidates(terrain, swept, 1, any, {}));
  });
  const auto find = [&](int threads) {
    return Measure(repetitions,
                   [&] { static_cast<void>(FindHorizon(terrain, {.threads = threads}, {})); });
  };
  const Cost whole = find(1);
  const Cost two = find(2);
  const Horizon horizon = std::move(*FindHorizon(terrain, {}, {}));
  const Cost sights =
      Measure(repetitions, [&] { static_cast<void>(FindLinesOfSight(terrain, horizon, 1, {})); });
  // As closely as horizon.geojson has them; once, as it takes longest.
  const Cost skyline_drops = Measure(1, [&] {
    const SkylineDrops all(terrain, horizon, kSkylineDropStep / dem.quantum_m);
    for (std::size_t i = 0; i < horizon.edges.size(); ++i) static_cast<void>(all.Of(i));
  });
  const PredicateCounts& counts = horizon.statistics.predicates;
  std::printf(
      "%5d x %-5d %8.1f %8.1f %8.1f %8.1f %8.1f %6.1f %6.2f %8.1f %8.1f %6.0f %6.0f %8lld %7zu "
      "%9.5f\n",
      dem.columns, dem.rows, floor.ms, sweep.ms, candidates.ms, whole.ms - sweep.ms - candidates.ms,
      whole.ms, whole.ms / floor.ms, whole.ms / two.ms, sights.ms, skyline_drops.ms,
      sweep.bytes_peak / posts, whole.bytes_peak / posts,
      static_cast<long long>(horizon.statistics.candidates), horizon.edges.size(),
      100.0 * static_cast<double>(counts.exact) / static_cast<double>(counts.Sum()));
  std::fflush(stdout);
  return {posts, whole};
}

int Main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: stages_bench DEM [REPETITIONS]\n");
    return 2;
  }
  Result<Dem> dem = ReadDem(argv[1], {});
  if (!dem) {
    std::fprintf(stderr, "stages_bench: %s\n", dem.error().message.c_str());
    return 1;
  }
  const int repetitions = argc > 2 ? std::max(std::atoi(argv[2]), 1) : 5;
  std::printf(
      "milliseconds, medians of %d; bytes a post at the peak\n"
      "        posts     floor    sweep    cands   decide    whole  /floor 2 cores   sights  "
      "promin."
      "  sweep  whole    cands   edges   exact %%\n",
      repetitions);
  std::vector<Row> rows;
  const std::int32_t side = std::min(dem->columns, dem->rows);
  for (const std::int32_t n : {65, 129, 257, 513, 1025}) {
    if (n < side) rows.push_back(Report(Cut(*dem, n, n), repetitions));
  }
  rows.push_back(Report(*dem, repetitions));
  if (rows.size() > 3) {
    const Row& from = rows[2];
    const Row& to = rows.back();
    std::printf(
        "from %.0f to %.0f posts the time grows as n^%.2f, the memory as n^%.2f\n", from.posts,
        to.posts, std::log(to.whole.ms / from.whole.ms) / std::log(to.posts / from.posts),
        std::log(to.whole.bytes_peak / from.whole.bytes_peak) / std::log(to.posts / from.posts));
  }
  return 0;
}

}  // namespace
}  // namespace farhorizon

int main(int argc, char** argv) { return farhorizon::Main(argc, argv); }
