#pragma once

#include <cstdint>
#include <optional>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The algorithm that finds the edges. Both find the same ones; kKinetic is the thesis's own
/// (kinetic_horizon.h), has its limits, and asks the adaptive decision for witnesses only: an edge without
/// one is an InternalError. kAuto: kAdaptive, which is the faster one on large terrain.
enum class Engine { kAuto, kAdaptive, kKinetic };

/// What a caller may wish of FindHorizon.
struct HorizonOptions {
  int threads = 1;  ///< never changes the answer
  Engine engine = Engine::kAuto;
  /// Most decisions (as PredicateCounts counts them) to be made about candidates; with the kinetic engine
  /// its own steps instead (kinetic_horizon.h). Unset: DefaultWorkBudget.
  std::optional<std::int64_t> work_budget = std::nullopt;
  /// Where the budget does not suffice, spend it once more on all candidates evenly, and keep those that
  /// are undecided then, marked as such, instead of failing. The set is then a superset of the horizon, with
  /// the same skyline. Where the budget does suffice this changes nothing.
  bool approximate = false;
};

/// 2000 decisions an edge of the terrain, and no less than 10^9 in all: some eighty times what the hardest
/// real DEM known needs. White noise takes n^1.8 in all, n its edges, and outgrows it: the set is 3SUM-hard.
std::int64_t DefaultWorkBudget(std::int64_t terrain_edges);

/// The edges of `terrain` that lie on the distant horizon for at least one line of sight: creases
/// that attain the greatest height over the line on a set of lines with non-empty interior.
///
/// Exact for every terrain but where it is approximate and says so; the same for any `threads`. Every
/// witness is exact.
/// Errors: kCancelled when the watch says stop; kUnsupportedData, kind sight-too-narrow, with an edge
/// that is on the horizon by a line of sight that a witness cannot say (occluder_set.h);
/// kResourceExhausted, kind work-budget, where the budget does not suffice; those of the kinetic engine.
/// Cost: about O(n log n) on real terrain; a few hundred bytes a candidate, some 20 a post.
Result<Horizon> FindHorizon(const Terrain& terrain, const HorizonOptions& options,
                            const Watch& watch);
inline Result<Horizon> FindHorizon(const Terrain& terrain, int threads, const Watch& watch,
                                   Engine engine = Engine::kAuto) {
  return FindHorizon(terrain, HorizonOptions{.threads = threads, .engine = engine}, watch);
}

}  // namespace farhorizon
