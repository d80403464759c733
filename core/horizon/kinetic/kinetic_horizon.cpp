#include "core/horizon/kinetic/kinetic_horizon.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/horizon/kinetic/bitangents/bitangent_scene.h"
#include "core/horizon/kinetic/kinetic_sweep.h"
#include "core/horizon/kinetic/neighbours/neighbour_scene.h"

namespace farhorizon {

namespace {

template <typename Scene>
Result<KineticHorizon> FindWith(const Terrain& terrain, const RunControl& control,
                                const KineticOptions& options, bool checks) {
  kinetic::KineticSweep<Scene> sweep(terrain, control, options, checks);
  Status run = sweep.Run();
  if (!run) return std::move(run.error());
  return sweep.Take();
}

Result<KineticHorizon> Find(const Terrain& terrain, const RunControl& control,
                            const KineticOptions& options, bool checks) {
  return options.tangents == KineticTangents::kAllPairs
             ? FindWith<kinetic::BitangentScene>(terrain, control, options, checks)
             : FindWith<kinetic::NeighbourScene>(terrain, control, options, checks);
}

}  // namespace

std::int64_t DefaultKineticWorkBudget(std::int64_t terrain_edges) {
  constexpr std::int64_t kPerEdge = 500;
  constexpr std::int64_t kLeast = 500'000'000;
  return std::max(kLeast, kPerEdge * terrain_edges);
}

Result<KineticHorizon> FindHorizonKinetic(const Terrain& terrain, const RunControl& control,
                                          const KineticOptions& options) {
  return Find(terrain, control, options, false);
}

Result<KineticHorizon> FindHorizonKineticChecked(const Terrain& terrain,
                                                 const KineticOptions& options) {
  return Find(terrain, {}, options, true);
}

}  // namespace farhorizon
