// Divides the error of level 0 between the lattice and the simplifier: the simplifier gets the
// error less what rounding can do to heights, and at least half of it. The encoded level is within
// the error asked for wherever rounding takes no more than the other half.
#include "core/pipeline/level_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/io/quantization_lattice.h"
#include "core/pipeline/level_lattice.h"

namespace farhorizon {

namespace {

constexpr double kEarthRadiusM = 6371000;  // mean; any value within a percent serves

// The corners of the box around all posts, in the local frame. All count, not those at the border
// alone: a projected grid bulges, and heights are inside.
Result<std::vector<Enu>> ReachOf(const Terrain& terrain, const Georeference& georeference) {
  std::vector<Enu> reach;
  std::vector<VertexId> row;
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (terrain.dem().HasData(v)) row.push_back(v);
    if (terrain.dem().Column(v) + 1 < terrain.dem().columns || row.empty()) continue;
    Result<std::vector<Enu>> points = georeference.ToEnu(row);
    if (!points) return points;
    reach.insert(reach.end(), points->begin(), points->end());
    Enu least = reach.front();
    Enu most = reach.front();
    for (const Enu& p : reach) {
      least = {std::min(least.east, p.east), std::min(least.north, p.north),
               std::min(least.up, p.up)};
      most = {std::max(most.east, p.east), std::max(most.north, p.north), std::max(most.up, p.up)};
    }
    reach = {least, most};
    row.clear();
  }
  return reach;
}

// The terrain's steepest slopes along rows and along columns, metres up per metre.
std::array<double, 2> SteepestSlopes(const TerrainInput& input) {
  double by_column = 0;
  double by_row = 0;
  const Dem& dem = input.dem();
  const auto rise = [&dem](VertexId a, VertexId b) {
    return dem.HasData(a) && dem.HasData(b) ? std::abs(dem.HeightM(b) - dem.HeightM(a)) : 0;
  };
  // Every triangle has a side along each axis: these are the gradient's components.
  for (VertexId v = 0; v < input.terrain().post_count(); ++v) {
    if (dem.Column(v) + 1 < dem.columns) by_column = std::max(by_column, rise(v, v + 1));
    if (dem.Row(v) + 1 < dem.rows) by_row = std::max(by_row, rise(v, v + dem.columns));
  }
  return {by_column / input.georeference().column_step_m(),
          by_row / input.georeference().row_step_m()};
}

// The most that rounding a vertex changes the height over a fixed point of the plan: half a step up
// or down, and half a step aside on each axis times the slope along it. Along other axes than the
// tile's own, a vertex moves by sqrt(3) / 2 steps at most, perhaps straight off the ground.
double HeightLost(double step_m, const std::array<double, 2>& slopes, FrameAxes axes) {
  const auto& [a, b] = slopes;
  if (axes == FrameAxes::kTile) return 0.5 * step_m * (1 + a + b);
  return 0.5 * std::numbers::sqrt3 * step_m * std::hypot(1, a, b);
}

std::string Metres(double value) {
  std::string text = std::to_string(value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text + " m";
}

}  // namespace

Result<LevelPlan> PlanLevels(const TerrainInput& input, const BuildOptions& options) {
  const double column_m = input.georeference().column_step_m();
  const double row_m = input.georeference().row_step_m();
  LevelPlan plan;
  plan.lods.column_bend = column_m * column_m / (2 * kEarthRadiusM);
  plan.lods.row_bend = row_m * row_m / (2 * kEarthRadiusM);
  const double cell_m = std::sqrt(column_m * row_m);
  plan.finest_side_m = FinestSideStep(input.georeference(), options.max_error_m.value_or(0));
  Result<std::vector<Enu>> reach = ReachOf(input.terrain(), input.georeference());
  if (!reach) return std::move(reach.error());
  const double step_m = ChooseLattice(*reach, plan.finest_side_m).step_m;
  plan.lods.threads = options.threads;
  plan.lods.part_triangles = options.tile_triangles;
  plan.lods.triangles = options.triangles;
  if (!options.triangles.empty()) return plan;

  const double lost = HeightLost(step_m, SteepestSlopes(input), input.georeference().axes().axes);
  const auto& [least_m, greatest_m] = input.report().heights_m;
  const double default_m = std::max(
      {std::min(cell_m / 8, (greatest_m - least_m) / 64), input.dem().quantum_m, 2 * lost});
  plan.max_error_m = options.max_error_m.value_or(default_m);
  if (lost >= plan.max_error_m) {
    return Error{ErrorCode::kInvalidArgument,
                 "a vertical error of " + Metres(plan.max_error_m) +
                     " is finer than positions in " + std::to_string(kMaxLatticeBits) +
                     " bits, which are " + Metres(step_m) + " apart over this DEM; ask for " +
                     Metres(2 * lost) + " or more",
                 "max-error-too-small"};
  }
  plan.lods.levels = options.levels;
  plan.lods.max_error_m = std::max(plan.max_error_m - lost, plan.max_error_m / 2);
  plan.lods.silhouette_error_m = options.silhouette_error_m;
  return plan;
}

int CoarsenessOf(const LevelPlan& plan, const Dem& dem, std::size_t level) {
  if (plan.lods.triangles.empty()) return static_cast<int>(level);
  // Level 0 by size has some 0.2 of all triangles, each further one 2/5 of the one before it.
  const double all = 2.0 * (dem.columns - 1) * (dem.rows - 1);
  const double share = static_cast<double>(plan.lods.triangles[level]) / all;
  int coarseness = 0;
  for (double next = 0.4 * 0.4; share <= next; next *= 0.4) ++coarseness;
  return coarseness;
}

}  // namespace farhorizon
