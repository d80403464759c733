#include "core/horizon/kinetic/kinetic_horizon.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/horizon/kinetic/kinetic_sweep.h"

namespace farhorizon {

namespace {

Result<KineticHorizon> Find(const Terrain& terrain, const RunControl& control, std::int64_t budget,
                            bool checks) {
  kinetic::KineticSweep sweep(terrain, control, budget, checks);
  Status run = sweep.Run();
  if (!run) return std::move(run.error());
  return sweep.Take();
}

}  // namespace

std::int64_t DefaultKineticWorkBudget(std::int64_t terrain_edges) {
  constexpr std::int64_t kPerEdge = 200;
  constexpr std::int64_t kLeast = 50'000'000;
  return std::max(kLeast, kPerEdge * terrain_edges);
}

Result<KineticHorizon> FindHorizonKinetic(const Terrain& terrain, const RunControl& control,
                                          std::optional<std::int64_t> work_budget) {
  return Find(terrain, control,
              work_budget.value_or(DefaultKineticWorkBudget(terrain.CountEdges())), false);
}

Result<KineticHorizon> FindHorizonKineticChecked(const Terrain& terrain) {
  return Find(terrain, {}, DefaultKineticWorkBudget(terrain.CountEdges()), true);
}

}  // namespace farhorizon
