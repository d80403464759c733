// One direction of the skyline: from the interval tree of the horizon edges' directions, beside the
// envelope of all horizon edges and that of all edges of the terrain. Medians over directions all
// around.
//
//   skyline_bench DEM [DIRECTIONS]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "core/horizon/find_horizon.h"
#include "core/horizon/lines_of_sight/directional_skyline.h"
#include "core/io/dem/read_dem.h"
#include "core/terrain/terrain.h"

namespace farhorizon {
namespace {

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// In milliseconds.
template <typename Work>
double Time(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

std::vector<ViewDirection> AllAround(int count) {
  std::vector<ViewDirection> views;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.37) / count;
    views.push_back({static_cast<std::int32_t>(std::lround(kMaxViewStep * std::cos(angle))),
                     static_cast<std::int32_t>(std::lround(kMaxViewStep * std::sin(angle)))});
  }
  return views;
}

int Measure(const char* path, int directions) {
  Result<Dem> dem = ReadDem(path, {});
  if (!dem) {
    std::fprintf(stderr, "skyline_bench: %s\n", dem.error().message.c_str());
    return 1;
  }
  const Terrain terrain = *Terrain::Build(*dem);
  Result<Horizon> horizon = FindHorizon(terrain, {}, {});
  if (!horizon) {
    std::fprintf(stderr, "skyline_bench: %s\n", horizon.error().message.c_str());
    return 1;
  }
  const std::vector<LinesOfSight> sights = *FindLinesOfSight(terrain, *horizon, 1, {});
  std::vector<Segment> edges;
  for (const Edge& e : terrain.Edges()) edges.push_back({terrain.Point(e.a), terrain.Point(e.b)});
  std::vector<Segment> seen;
  for (const HorizonEdge& e : horizon->edges) {
    seen.push_back({terrain.Point(e.edge.a), terrain.Point(e.edge.b)});
  }
  const double build = Time([&] { DirectionalSkylines(terrain, *horizon, sights); });
  const DirectionalSkylines skylines(terrain, *horizon, sights);
  std::vector<double> tree;
  std::vector<double> set;
  std::vector<double> all;
  std::size_t parts = 0;
  for (const ViewDirection& view : AllAround(directions)) {
    tree.push_back(Time([&] { parts += skylines.Along(view).size(); }));
    set.push_back(Time([&] { parts += UpperEnvelope(seen, view).size(); }));
    all.push_back(Time([&] { parts += UpperEnvelope(edges, view).size(); }));
  }
  std::printf("%zu edges, %zu on the horizon, parts in sight %zu on average\n", edges.size(),
              seen.size(), parts / 3 / static_cast<std::size_t>(directions));
  std::printf(
      "ms: tree %.2f to build; a direction %.3f by the tree, %.3f from the set, "
      "%.1f from the terrain\n",
      build, Median(tree), Median(set), Median(all));
  return 0;
}

}  // namespace
}  // namespace farhorizon

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: skyline_bench DEM [DIRECTIONS]\n");
    return 2;
  }
  return farhorizon::Measure(argv[1], argc > 2 ? std::max(std::atoi(argv[2]), 1) : 36);
}
