// The time to find a terrain's horizon edges: on fractal terrain, where the size is ours to choose,
// and on the real DEMs of FARHORIZON_DEM_DIR, where it is not.
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/horizon/find_horizon.h"
#include "core/horizon/kinetic/kinetic_horizon.h"
#include "core/io/dem/read_dem.h"
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
    Result<Horizon> horizon = FindHorizon(*terrain, {.threads = threads}, {});
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

void FindHorizonOf(benchmark::State& state, const std::filesystem::path& path) {
  Result<Dem> dem = ReadDem(path, {});
  if (!dem) {
    state.SkipWithError(dem.error().message.c_str());
    return;
  }
  MeasureHorizon(state, *dem, 1);
}

// Counters: the events of the kinetic engine, to be held against chapter 4 of [Archambault03].
void FindHorizonKineticOf(benchmark::State& state, const std::filesystem::path& path,
                          HullCertificates hull) {
  Result<Dem> dem = ReadDem(path, {});
  if (!dem) {
    state.SkipWithError(dem.error().message.c_str());
    return;
  }
  Result<Terrain> terrain = Terrain::Build(*dem);
  if (!terrain) {
    state.SkipWithError(terrain.error().message.c_str());
    return;
  }
  EventCounts events;
  for (auto _ : state) {
    Result<KineticHorizon> horizon = FindHorizonKinetic(*terrain, {}, {.hull = hull});
    if (!horizon) {
      state.SkipWithError(horizon.error().message.c_str());
      return;
    }
    events = horizon->events;
  }
  const auto count = [&state](const char* name, std::int64_t value) {
    state.counters[name] = static_cast<double>(value);
  };
  count("peak", events.peak);
  count("regular", events.regular);
  count("saddle", events.saddle);
  count("minimum", events.minimum);
  count("merge", events.merge);
  count("hull", events.hull);
  count("inside", events.inside);
  for (std::size_t i = 0; i < events.tree.size(); ++i) {
    count(std::array{"x", "yl_yr", "yt", "slt_srt", "sl_sr"}[i], events.tree[i]);
  }
  count("cover", events.cover);
  count("separation", events.separation);
  count("tangents_max", events.tangents_max);
  count("clusters_max", events.clusters_max);
  count("queue_max", events.queue_max);
}

// Nothing is registered where the folder is absent.
void RegisterRealDems() {
  std::vector<std::filesystem::path> paths;
  std::error_code absent;
  for (const auto& entry : std::filesystem::directory_iterator(FARHORIZON_DEM_DIR, absent)) {
    if (entry.path().extension() == ".tif") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const std::filesystem::path& path : paths) {
    benchmark::RegisterBenchmark(("FindHorizonOf/" + path.stem().string()).c_str(), FindHorizonOf,
                                 path)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
    for (const auto& [name, hull] :
         {std::pair("FindHorizonKineticOf/", HullCertificates::kTurns),
          std::pair("FindHorizonKineticTreeOf/", HullCertificates::kTree)}) {
      benchmark::RegisterBenchmark((name + path.stem().string()).c_str(), FindHorizonKineticOf,
                                   path, hull)
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace
}  // namespace farhorizon

int main(int argc, char** argv) {
  farhorizon::RegisterRealDems();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
