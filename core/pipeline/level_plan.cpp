// Divides each level's errors between the lattice and the simplifier: the simplifier gets the error
// less what rounding can do to heights, and at least half of it. The encoded level is within the
// error asked for wherever rounding takes no more than the other half.
#include "core/pipeline/level_plan.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/pipeline/level_artifact.h"

namespace farhorizon {

namespace {

constexpr double kEarthRadiusM = 6371000;  // mean; any value within a percent serves

// The sum of the terrain's steepest slopes along rows and along columns, metres up per metre.
double SteepestSlopes(const TerrainInput& input) {
  const double quantum_m = input.dem().quantum_m;
  double by_column = 0;
  double by_row = 0;
  for (const Edge& edge : input.terrain().Edges()) {
    const Point3i a = input.terrain().Point(edge.a);
    const Point3i b = input.terrain().Point(edge.b);
    const double rise_m = std::abs(static_cast<double>(b.z) - a.z) * quantum_m;
    // Every triangle has a side along each axis: these are the gradient's components.
    if (a.y == b.y) by_column = std::max(by_column, rise_m / input.georeference().column_step_m());
    if (a.x == b.x) by_row = std::max(by_row, rise_m / input.georeference().row_step_m());
  }
  return by_column + by_row;
}

// The most that rounding a vertex changes the height over a fixed point of the plan: half a step up
// or down, and half a step aside on each axis times the slope along it.
double HeightLost(double step_m, double slopes) { return 0.5 * step_m * (1 + slopes); }

std::string Metres(double value) {
  std::string text = std::to_string(value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text + " m";
}

}  // namespace

Result<std::vector<LevelPlan>> PlanLevels(const TerrainInput& input, const BuildOptions& options) {
  const double cell_m =
      std::sqrt(input.georeference().column_step_m() * input.georeference().row_step_m());
  const double slopes = SteepestSlopes(input);
  std::vector<LevelPlan> plans;
  double max_error_m = options.max_error_m.value_or(cell_m / 8);
  for (int level = 0; level < options.levels; ++level, max_error_m *= 2) {
    LevelPlan plan;
    plan.max_error_m = max_error_m;
    plan.silhouette_error_m = level == 0 ? options.silhouette_error_m
                                         : std::max(options.silhouette_error_m, max_error_m / 8);
    // A 16th of max_error_m / 8, the silhouette error of levels above 0.
    Result<QuantizationLattice> lattice =
        LatticeFor(input.terrain(), input.georeference(), max_error_m / 128);
    if (!lattice) return std::move(lattice.error());
    plan.lattice = *lattice;
    const double step_m = plan.lattice.step_m;
    const double lost = HeightLost(step_m, slopes);
    if (lost >= max_error_m && options.max_error_m) {
      return Error{ErrorCode::kInvalidArgument,
                   "a vertical error of " + Metres(max_error_m) +
                       " is finer than positions in 16 bits, which are " + Metres(step_m) +
                       " apart over this DEM; ask for " + Metres(std::ceil(2 * lost)) + " or more",
                   "max-error-too-small"};
    }
    plan.budget.vertical_error_m = std::max(max_error_m - lost, max_error_m / 2);
    plan.budget.silhouette_error_m =
        level == 0 ? plan.silhouette_error_m
                   : std::max(plan.silhouette_error_m - lost, plan.silhouette_error_m / 2);
    // An edge of length l sinks l^2 / (8 R) below the curved earth: a quarter of the error at this
    // length, in the longer of both steps.
    plan.budget.longest_edge =
        std::sqrt(8 * kEarthRadiusM * max_error_m / 4) /
        std::max(input.georeference().column_step_m(), input.georeference().row_step_m());
    // Rounding moves each end of a side by at most sqrt(2) / 2 steps in plan. Twice the altitude at
    // which two such moves could flip a triangle, in the shorter of both steps.
    plan.budget.least_altitude =
        2 * std::sqrt(2.0) * step_m /
        std::min(input.georeference().column_step_m(), input.georeference().row_step_m());
    plans.push_back(plan);
  }
  return plans;
}

}  // namespace farhorizon
