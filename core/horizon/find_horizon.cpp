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

Error TooNarrow(const Terrain& terrain, Edge edge) {
  const auto post = [&terrain](VertexId v) {
    const Point3i p = terrain.Point(v);
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ") of height " +
           std::to_string(p.z);
  };
  return {ErrorCode::kUnsupportedData,
          "the edge from post " + post(edge.a) + " to post " + post(edge.b) +
              " quanta is on the horizon through a gap too narrow for the witness to be written: "
              "cliffs of this height differ by too little; round the heights to a coarser unit, or "
              "mark spikes as nodata",
          "sight-too-narrow"};
}

Error OverBudget(std::int64_t budget, std::size_t candidates) {
  return {ErrorCode::kResourceExhausted,
          "deciding " + std::to_string(candidates) +
              " candidate edges takes more than the work budget of " + std::to_string(budget) +
              " decisions: white noise and forests of spikes are hard without end; keep what stays "
              "undecided (approximate), raise the work budget, or smooth the heights",
          "work-budget"};
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

Result<Horizon> FindHorizon(const Terrain& terrain, const HorizonOptions& options,
                            const RunControl& control) {
  Result<HullSweep> sweep = SweepHulls(terrain, options.threads, control);
  if (!sweep) return std::move(sweep.error());
  Result<Candidates> candidates = FindCandidates(terrain, *sweep, options.threads, control);
  if (!candidates) return std::move(candidates.error());
  Horizon horizon;
  horizon.statistics = sweep->statistics;
  horizon.statistics.candidates = static_cast<std::int64_t>(candidates->edges.size());
  horizon.hulls = std::move(sweep->hulls);
  const bool kinetic = options.engine != Engine::kAdaptive;
  std::int64_t budget = DefaultWorkBudget(horizon.statistics.terrain_edges);
  if (kinetic) {
    Result<EventCounts> events = KeepKineticEdges(terrain, *candidates, control, options);
    if (!events) return std::move(events.error());
    SetCounts(horizon.statistics, *events);
  } else {
    budget = options.work_budget.value_or(budget);
  }
  horizon.statistics.work_budget = budget;
  control.Report(Stage::kDecide, 0);
  CandidateDecider decider(terrain, *candidates, control);
  bool completed = decider.DecideAll(options.threads, budget, options.approximate ? 0.5 : 1);
  if (completed && decider.undecided() > 0) {
    if (!options.approximate) return OverBudget(budget, candidates->edges.size());
    completed = decider.DecideSome(options.threads, budget);
  }
  if (!completed) return Error{ErrorCode::kCancelled, "stopped while deciding horizon edges"};
  horizon.statistics.predicates = decider.counts();
  horizon.statistics.undecided = decider.undecided();
  decider.AppendEdges(horizon);
  if (decider.undecided() > 0) control.Warn(ApproximationWarning(horizon));
  Check(!kinetic || horizon.edges.size() == candidates->edges.size(),
        "every edge of the kinetic engine has a line of sight");
  for (const HorizonEdge& e : horizon.edges) {
    if (!e.witness.exact) return TooNarrow(terrain, e.edge);
    Check(!kinetic || e.undecided || WitnessHolds(terrain, e.edge, e.witness),
          "a line of sight over the kinetic engine's edges is one over the terrain");
  }
  control.Report(Stage::kDecide, 1);
  return horizon;
}

}  // namespace farhorizon
