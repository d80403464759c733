// The time to find a terrain's horizon edges: on fractal terrain, where the size is ours to choose.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstdint>
#include <random>
#include <string>

#include "core/horizon/horizon.h"
#include "core/terrain/terrain.h"

namespace farhorizon {
namespace {

// Fractal terrain by midpoint displacement (diamond-square, the corners level): whole heights of the
// character of mountains in metres, relief about half the side. Integers, and an engine whose stream
// the standard fixes: the same terrain everywhere.
// Requires: side = 2^k + 1.
Dem FractalDem(std::int32_t side, std::uint32_t seed) {
  Dem dem;
  dem.columns = dem.rows = side;
  dem.heights.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0);
  std::mt19937 random(seed);
  const auto at = [&dem, side](std::int32_t column, std::int32_t row) -> std::int32_t& {
    return dem.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
                       static_cast<std::size_t>(column)];
  };
  for (std::int32_t step = side - 1; step > 1; step /= 2) {
    const std::int32_t half = step / 2;
    // The mean of the posts at distance `half`, along the axes or the diagonals, and a displacement
    // as large as the step: a Hurst exponent of 1, a little smoother than real mountains.
    const auto displace = [&](std::int32_t column, std::int32_t row, bool diagonal) {
      const std::int32_t dc[] = {-half, half, diagonal ? half : 0, diagonal ? -half : 0};
      const std::int32_t dr[] = {diagonal ? -half : 0, diagonal ? half : 0, -half, half};
      std::int32_t sum = 0;
      std::int32_t count = 0;
      for (int i = 0; i < 4; ++i) {
        const std::int32_t c = column + dc[i];
        const std::int32_t r = row + dr[i];
        if (c < 0 || r < 0 || c >= side || r >= side) continue;
        sum += at(c, r);
        ++count;
      }
      const auto noise = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(step + 1));
      at(column, row) = sum / count + noise - half;
    };
    for (std::int32_t row = half; row < side; row += step) {
      for (std::int32_t column = half; column < side; column += step) displace(column, row, true);
    }
    for (std::int32_t row = 0; row < side; row += half) {
      const std::int32_t first = (row / half) % 2 == 0 ? half : 0;
      for (std::int32_t column = first; column < side; column += step) {
        displace(column, row, false);
      }
    }
  }
  return dem;
}

// Counters: what was found, and terrain edges a second.
void MeasureHorizon(benchmark::State& state, const Dem& dem, int threads) {
  Result<Terrain> terrain = Terrain::Build(dem);
  if (!terrain) {
    state.SkipWithError(terrain.error().message.c_str());
    return;
  }
  HorizonStatistics statistics;
  std::size_t found = 0;
  for (auto _ : state) {
    Result<Horizon> horizon = FindHorizon(*terrain, threads, {});
    if (!horizon) {
      state.SkipWithError(horizon.error().message.c_str());
      return;
    }
    statistics = horizon->statistics;
    found = horizon->edges.size();
    benchmark::DoNotOptimize(horizon->edges.data());
  }
  state.counters["terrain_edges"] = static_cast<double>(statistics.terrain_edges);
  state.counters["candidates"] = static_cast<double>(statistics.candidates);
  state.counters["horizon_edges"] = static_cast<double>(found);
  state.counters["clusters_max"] = static_cast<double>(statistics.clusters_max);
  state.counters["edges_per_second"] = benchmark::Counter(
      static_cast<double>(statistics.terrain_edges), benchmark::Counter::kIsIterationInvariantRate);
}

void FindHorizonOfFractal(benchmark::State& state) {
  const Dem dem = FractalDem(static_cast<std::int32_t>(state.range(0)), 1);
  MeasureHorizon(state, dem, static_cast<int>(state.range(1)));
}

BENCHMARK(FindHorizonOfFractal)
    ->ArgNames({"side", "threads"})
    ->ArgsProduct({{65, 129, 257, 513}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace farhorizon

BENCHMARK_MAIN();
