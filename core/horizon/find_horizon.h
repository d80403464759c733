#pragma once

#include <cstdint>
#include <optional>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/horizon/work_budget.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The algorithm that finds the edges. Both find the same ones. kKinetic is the thesis's own
/// (kinetic_horizon.h) and has its limits; it uses the adaptive decision for witnesses only, and an
/// edge without a witness is an InternalError. kKineticTree is the same with hulls certified by the
/// tree of [BaschGuibasHershberger97].
enum class Engine { kAdaptive, kKinetic, kKineticTree };

struct HorizonOptions {
  int threads = 1;  ///< never changes the answer
  Engine engine = Engine::kAdaptive;
  /// The most decisions of the whole run (work_budget.h); for the kinetic engine the most steps of
  /// its own (kinetic_horizon.h). Unset: DefaultWorkBudget.
  std::optional<std::int64_t> work_budget = std::nullopt;
  /// What happens where the budget does not suffice. false: an error. true: what is left of it is
  /// spent once more, evenly on all candidates, and those that are undecided then are kept and
  /// marked; the edges are a superset of the horizon edges with the same skyline. Where the budget
  /// suffices, no difference.
  bool approximate = false;
  /// Where the budget is approximate and short: the share of what is left of it that deciding edges
  /// may take. The rest is for what is said of them.
  double budget_share = 1;
};

/// 2000 decisions for each edge of the terrain, at least 10^9 in all: some eighty times what the
/// set of the hardest real DEM known needs. White noise of n edges takes about n^1.8 decisions in
/// all and so exceeds it for large n: the problem is 3SUM-hard.
std::int64_t DefaultWorkBudget(std::int64_t terrain_edges);

/// The budget of a run on the terrain with these options.
WorkBudget WorkBudgetOf(const Terrain& terrain, const HorizonOptions& options);

/// The edges of `terrain` on the distant horizon of at least one line of sight: creases that attain
/// the greatest height over the line on a set of lines with interior points
/// (core/horizon/README.md, definition D2).
///
/// Exact for every terrain, except edges that are marked undecided. The same for any number of
/// threads. Witnesses are exact too, except where an edge is certainly on the horizon and no
/// witness can be represented (witness.h); the number of those is warned of.
/// Errors: kCancelled; kResourceExhausted, kind work-budget, where the budget does not suffice;
/// those of the kinetic engine.
/// Cost: about O(n log n) on real terrain; a few hundred bytes for each candidate, some 20 for each
/// post.
///
/// budget: of the run, WorkBudgetOf; what is left of it is for what is said of the edges.
Result<Horizon> FindHorizon(const Terrain& terrain, const HorizonOptions& options,
                            WorkBudget& budget, const RunControl& control);

/// The same for a run that finds the edges only.
Result<Horizon> FindHorizon(const Terrain& terrain, const HorizonOptions& options,
                            const RunControl& control);

}  // namespace farhorizon
