// The time to find a terrain's horizon edges: on fractal terrain, where the size is ours to choose.
#include <cstdint>

#include <benchmark/benchmark.h>

#include "core/horizon/horizon.h"
#include "core/terrain/terrain.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

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
  const auto side = static_cast<std::int32_t>(state.range(0));
  // Relief as in mountains with posts 30 m apart.
  const Dem dem = FractalDem(side, 4 * side, 100, 1);
  MeasureHorizon(state, dem, static_cast<int>(state.range(1)));
}

BENCHMARK(FindHorizonOfFractal)
    ->ArgNames({"side", "threads"})
    ->ArgsProduct({{65, 129, 257, 513, 1025}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace farhorizon

BENCHMARK_MAIN();
