#include "core/pipeline/level_plan.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/pipeline/level_artifact.h"

namespace farhorizon {
namespace {

constexpr double kEarthRadiusM = 6371000;

// The terrain's steepest slopes along columns and along rows together, metres up a metre along.
double SteepestSlopes(const TerrainInput& source) {
  const double quantum_m = source.dem().quantum_m;
  double by_column = 0;
  double by_row = 0;
  for (const Edge& edge : source.terrain().Edges()) {
    const Point3i a = source.terrain().Point(edge.a);
    const Point3i b = source.terrain().Point(edge.b);
    const double rise_m = std::abs(static_cast<double>(b.z) - a.z) * quantum_m;
    // Every triangle has a side along each axis.
    if (a.y == b.y) by_column = std::max(by_column, rise_m / source.georeference().column_step_m());
    if (a.x == b.x) by_row = std::max(by_row, rise_m / source.georeference().row_step_m());
  }
  return by_column + by_row;
}

// What rounding a vertex by half a step on each axis does to the height over a fixed place.
double HeightLost(double step_m, double slopes) { return 0.5 * step_m * (1 + slopes); }

std::string Metres(double value) {
  std::string text = std::to_string(value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text + " m";
}

}  // namespace

Result<std::vector<LevelPlan>> PlanLevels(const TerrainInput& source, const BuildOptions& options) {
  const double cell_m =
      std::sqrt(source.georeference().column_step_m() * source.georeference().row_step_m());
  const double slopes = SteepestSlopes(source);
  std::vector<LevelPlan> plans;
  double max_error_m = options.max_error_m.value_or(cell_m / 8);
  for (int level = 0; level < options.levels; ++level, max_error_m *= 2) {
    LevelPlan plan;
    plan.max_error_m = max_error_m;
    plan.silhouette_error_m = level == 0 ? options.silhouette_error_m
                                         : std::max(options.silhouette_error_m, max_error_m / 8);
    Result<QuantizationLattice> lattice =
        LatticeFor(source.terrain(), source.georeference(), max_error_m / 128);
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
    // A flat triangle of this length sinks a quarter of the error below the curved earth.
    plan.budget.longest_edge =
        std::sqrt(8 * kEarthRadiusM * max_error_m / 4) /
        std::max(source.georeference().column_step_m(), source.georeference().row_step_m());
    plan.budget.least_altitude =
        2 * std::sqrt(2.0) * step_m /
        std::min(source.georeference().column_step_m(), source.georeference().row_step_m());
    plans.push_back(plan);
  }
  return plans;
}

}  // namespace farhorizon
