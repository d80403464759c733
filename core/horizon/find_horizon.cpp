// The exact set of edges on the distant horizon: definition D2 (core/horizon/README.md, section 2)
// of the problem of [Archambault03] and [Archambault05].
//
// Adaptive engine: the sweep (hull_sweep.h, candidates.h) leaves candidates. They contain every
// horizon edge, so they make the same skyline as the whole terrain (theorem 2), and each candidate
// is decided against the others, exactly (candidate_decider.h).
//
// Kinetic engine: only the edges that it finds stay candidates. Each must then be visible over the
// others, and its witness must hold over the whole terrain.
#include "core/horizon/find_horizon.h"

#include <algorithm>
#include <optional>
#include <string>

#include "core/horizon/candidate_decider.h"
#include "core/horizon/kinetic/kinetic_horizon.h"
#include "core/horizon/sweep/candidates.h"
#include "core/horizon/sweep/hull_sweep.h"

namespace farhorizon {

namespace {

std::string TooNarrowWarning(std::int64_t edges) {
  return std::to_string(edges) +
         " edges are on the horizon through gaps too narrow for a witness to be written, between "
         "cliffs whose heights differ by too little; they have none";
}

std::string ApproximationWarning(const Horizon& horizon) {
  return "approximate: the work budget of " + std::to_string(horizon.statistics.work_budget) +
         " decisions leaves " + std::to_string(horizon.statistics.undecided) + " of " +
         std::to_string(horizon.edges.size()) + " edges undecided; they are kept, and marked";
}

// Removes the candidates that the kinetic engine does not find. Those that stay make the same
// skyline as the terrain, so they suffice as occluders, too.
Result<EventCounts> KeepKineticEdges(const Terrain& terrain, Candidates& candidates,
                                     const RunControl& control, const HorizonOptions& options) {
  const KineticOptions kinetic_options{.work_budget = options.work_budget,
                                       .hull = options.engine == Engine::kKineticTree
                                                   ? HullCertificates::kTree
                                                   : HullCertificates::kTurns};
  Result<KineticHorizon> kinetic = FindHorizonKinetic(terrain, control, kinetic_options);
  if (!kinetic) return std::move(kinetic.error());
  std::erase_if(candidates.edges, [&](const Candidate& candidate) {
    return !std::binary_search(kinetic->edges.begin(), kinetic->edges.end(), candidate.edge);
  });
  Check(candidates.edges.size() == kinetic->edges.size(),
        "every edge of the kinetic engine is a candidate of the adaptive one");
  return kinetic->events;
}

void SetCounts(HorizonStatistics& statistics, const EventCounts& events) {
  statistics.peaks = events.peak;
  statistics.births = events.peak;
  statistics.regular = events.regular;
  statistics.saddles = events.saddle;
  statistics.minima = events.minimum;
  statistics.merges = events.merge;
  statistics.hull_changes = events.hull;
  statistics.bitangents = events.Bitangents();
  statistics.clusters_max = events.clusters_max;
  statistics.queue_max = events.queue_max;
}

}  // namespace

std::int64_t DefaultWorkBudget(std::int64_t terrain_edges) {
  constexpr std::int64_t kPerEdge = 2000;
  constexpr std::int64_t kLeast = 1'000'000'000;
  return std::max(kLeast, kPerEdge * terrain_edges);
}

WorkBudget WorkBudgetOf(const Terrain& terrain, const HorizonOptions& options) {
  // The option counts the kinetic engine's own steps.
  const std::optional<std::int64_t> given =
      options.engine != Engine::kAdaptive ? std::nullopt : options.work_budget;
  return WorkBudget(given ? *given : DefaultWorkBudget(terrain.CountEdges()), options.approximate);
}

Result<Horizon> FindHorizon(const Terrain& terrain, const HorizonOptions& options,
                            const RunControl& control) {
  WorkBudget budget = WorkBudgetOf(terrain, options);
  return FindHorizon(terrain, options, budget, control);
}

Result<Horizon> FindHorizon(const Terrain& terrain, const HorizonOptions& options,
                            WorkBudget& budget, const RunControl& control) {
  Horizon horizon;
  Candidates candidates;
  {
    Result<HullSweep> sweep = SweepHulls(terrain, options.threads, control);
    if (!sweep) return std::move(sweep.error());
    Result<Candidates> found = FindCandidates(terrain, *sweep, options.threads, budget, control);
    if (!found) return std::move(found.error());
    candidates = *std::move(found);
    horizon.statistics = sweep->statistics;
    horizon.hulls = std::move(sweep->hulls);
  }
  horizon.statistics.candidates = std::ssize(candidates.edges);
  const bool kinetic = options.engine != Engine::kAdaptive;
  if (kinetic) {
    Result<EventCounts> events = KeepKineticEdges(terrain, candidates, control, options);
    if (!events) return std::move(events.error());
    SetCounts(horizon.statistics, *events);
  }
  horizon.statistics.work_budget = budget.limit();
  control.Report(Stage::kDecide, 0);
  CandidateDecider decider(terrain, candidates);
  Status decided = decider.Decide(
      {.threads = options.threads, .budget_share = options.budget_share}, budget, control);
  if (!decided) return std::move(decided.error());
  horizon.statistics.predicates = decider.counts();
  horizon.statistics.undecided = decider.undecided();
  decider.AppendEdges(horizon);
  if (decider.undecided() > 0) control.Warn(ApproximationWarning(horizon));
  Check(!kinetic || horizon.edges.size() == candidates.edges.size(),
        "every edge of the kinetic engine has a line of sight");
  std::int64_t too_narrow = 0;
  for (const HorizonEdge& e : horizon.edges) {
    too_narrow += e.witness.exact ? 0 : 1;
    Check(!kinetic || e.undecided || !e.witness.exact || WitnessHolds(terrain, e.edge, e.witness),
          "a line of sight over the kinetic engine's edges is one over the terrain");
  }
  if (too_narrow > 0) control.Warn(TooNarrowWarning(too_narrow));
  return horizon;
}

}  // namespace farhorizon
