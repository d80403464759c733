// The exact set of edges on the distant horizon, definition D2 of [Archambault05]'s problem:
// creases that attain the greatest height over a line of sight on an open set of lines. The sweep
// (hull_sweep.h) leaves candidates, which contain every horizon edge and so make the same skyline
// as the whole terrain; each is then sighted over the others, exactly (skyline.h).
#include "core/horizon/horizon.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <thread>

#include "core/horizon/horizon_kinetic.h"
#include "core/horizon/hull_sweep.h"

namespace farhorizon {
namespace {

constexpr std::size_t kBatch = 256;  // candidates between two looks at the stop token

// Decides candidates batch by batch; every thread writes to the slots of its own batches.
class Decider {
 public:
  Decider(const Terrain& terrain, const HullSweep& sweep, const Watch& watch)
      : terrain_(terrain),
        candidates_(sweep.candidates),
        screens_(sweep.screens),
        watch_(watch),
        skyline_(terrain.dem().columns, terrain.dem().rows),
        witnesses_(sweep.candidates.size()),
        decided_(sweep.candidates.size(), 0),
        undecided_(sweep.candidates.size()) {
    std::iota(undecided_.begin(), undecided_.end(), std::size_t{0});
    for (const Candidate& candidate : candidates_) {
      skyline_.Insert({terrain.Point(candidate.edge.a), terrain.Point(candidate.edge.b)});
    }
  }

  /// Decides all, or leaves all undecided where that takes more than the budget: a sum, so that the
  /// threads do not matter. False where the watch said stop.
  bool DecideAll(int threads, std::int64_t budget, PredicateCounts& counts) {
    Round(threads, {budget, budget}, counts);
    if (spent_ <= budget) undecided_.clear();
    return !watch_.StopRequested();
  }

  /// Decides what the budget suffices for. Every undecided candidate may take an equal share of what is
  /// left of it; what the easy ones leave over makes the next round's share larger, until none is
  /// undecided or it no longer doubles. False where the watch said stop.
  bool DecideSome(int threads, std::int64_t budget, PredicateCounts& counts) {
    counts = {};
    std::fill(decided_.begin(), decided_.end(), 0);
    for (std::int64_t share = 0; !undecided_.empty() && !watch_.StopRequested();) {
      const std::int64_t next =
          (budget - counts.Sum()) / static_cast<std::int64_t>(undecided_.size());
      if (next < std::max<std::int64_t>(2 * share, 1)) break;
      share = next;
      Round(threads, {share, std::numeric_limits<std::int64_t>::max()}, counts);
      std::erase_if(undecided_, [this](std::size_t i) { return decided_[i] != 0; });
    }
    return !watch_.StopRequested();
  }

  [[nodiscard]] std::int64_t undecided() const {
    return static_cast<std::int64_t>(undecided_.size());
  }

  /// The edges, and the screens of each.
  void AppendEdges(Horizon& horizon) const {
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const std::optional<Witness>& witness = witnesses_[i];
      const bool undecided = decided_[i] == 0;
      if (!undecided && !witness) continue;
      const Candidate& c = candidates_[i];
      horizon.edges.push_back({c.edge, undecided ? Witness{} : witness.value(), undecided});
      for (const Segment& screen : screens_.subspan(c.first_screen, c.screen_count)) {
        horizon.screens.push_back(screen);
      }
      horizon.screen_ends.push_back(horizon.screens.size());
    }
  }

 private:
  struct Limits {
    std::int64_t each = 0;  ///< decisions about one candidate
    std::int64_t all = 0;   ///< about all of them
  };

  void Round(int threads, Limits limits, PredicateCounts& counts) {
    next_ = 0;
    spent_ = 0;
    std::vector<PredicateCounts> per_thread(static_cast<std::size_t>(std::max(threads, 1)));
    std::vector<std::exception_ptr> failures(per_thread.size());
    {
      std::vector<std::jthread> helpers;
      for (std::size_t i = 1; i < per_thread.size(); ++i) {
        helpers.emplace_back([this, i, limits, &per_thread, &failures] {
          try {
            Work(limits, per_thread[i], false);
          } catch (...) {
            failures[i] = std::current_exception();
          }
        });
      }
      Work(limits, per_thread[0], true);
    }
    for (const std::exception_ptr& failure : failures) {
      if (failure) std::rethrow_exception(failure);
    }
    for (const PredicateCounts& c : per_thread) {
      counts.filtered += c.filtered;
      counts.exact += c.exact;
      counts.tied += c.tied;
    }
  }

  struct Blockers {
    std::vector<Skyline::Id> likely;  ///< of the last hidden candidate
    std::vector<Skyline::Id> found;
  };

  void Work(Limits limits, PredicateCounts& counts, bool reports) {
    // What hides one candidate is likely to hide the next. Never carried over from one batch to
    // another: who did that one depends on the threads.
    Blockers blockers;
    while (!watch_.StopRequested() && spent_ <= limits.all) {
      const std::size_t begin = next_.fetch_add(kBatch);
      if (begin >= undecided_.size()) return;
      const std::size_t end = std::min(begin + kBatch, undecided_.size());
      blockers.likely.clear();
      const std::int64_t before = counts.Sum();
      for (std::size_t k = begin; k < end; ++k) {
        Decide(undecided_[k], limits.each, blockers, counts);
      }
      spent_ += counts.Sum() - before;
      done_ += end - begin;
      if (reports) {
        // Later rounds do again what earlier ones have counted as done.
        const double done = static_cast<double>(done_) / static_cast<double>(candidates_.size());
        watch_.Report("decide", std::min(done, 1.0));
      }
    }
  }

  void Decide(std::size_t i, std::int64_t most, Blockers& blockers, PredicateCounts& counts) {
    const Candidate& c = candidates_[i];
    SightLimit limit{most};
    blockers.found.clear();
    witnesses_[i] = skyline_.FindSight({terrain_.Point(c.edge.a), terrain_.Point(c.edge.b)},
                                       Ties::kPass, static_cast<Skyline::Id>(i), &blockers.found,
                                       &counts, screens_.subspan(c.first_screen, c.screen_count),
                                       blockers.likely, &limit);
    decided_[i] = witnesses_[i] || !limit.reached ? 1 : 0;
    if (!witnesses_[i] && !blockers.found.empty()) std::swap(blockers.likely, blockers.found);
  }

  const Terrain& terrain_;
  const std::vector<Candidate>& candidates_;
  std::span<const Segment> screens_;
  const Watch& watch_;
  Skyline skyline_;
  std::vector<std::optional<Witness>> witnesses_;
  std::vector<char> decided_;  // each its own byte: threads write side by side
  std::vector<std::size_t> undecided_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> done_{0};
  std::atomic<std::int64_t> spent_{0};  // decisions in this round
};

}  // namespace

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

// Leaves of the candidates the edges that the kinetic engine finds: they make the same skyline as the
// terrain, so they do for obstacles, too.
Result<EventCounts> KeepKineticEdges(const Terrain& terrain, HullSweep& sweep, const Watch& watch,
                                     std::optional<std::int64_t> work_budget) {
  Result<KineticHorizon> kinetic = FindHorizonKinetic(terrain, watch, work_budget);
  if (!kinetic) return std::move(kinetic.error());
  std::erase_if(sweep.candidates, [&](const Candidate& candidate) {
    return !std::binary_search(kinetic->edges.begin(), kinetic->edges.end(), candidate.edge);
  });
  Check(sweep.candidates.size() == kinetic->edges.size(),
        "every edge of the kinetic engine is a candidate of the adaptive one");
  return kinetic->events;
}

void Tell(const EventCounts& events, HorizonStatistics& statistics) {
  statistics.peaks = events.peak;
  statistics.births = events.peak;
  statistics.regular = events.regular;
  statistics.saddles = events.saddle;
  statistics.minima = events.minimum;
  statistics.merges = events.merge;
  statistics.hull_changes = events.hull;
  statistics.bitangents = events.bitangent;
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
                            const Watch& watch) {
  Result<HullSweep> sweep = SweepHulls(terrain, watch);
  if (!sweep) return std::move(sweep.error());
  Horizon horizon;
  horizon.statistics = sweep->statistics;
  horizon.hulls = std::move(sweep->hulls);
  const bool kinetic = options.engine == Engine::kKinetic;
  std::int64_t budget = DefaultWorkBudget(horizon.statistics.terrain_edges);
  if (kinetic) {
    Result<EventCounts> events = KeepKineticEdges(terrain, *sweep, watch, options.work_budget);
    if (!events) return std::move(events.error());
    Tell(*events, horizon.statistics);
  } else {
    budget = options.work_budget.value_or(budget);
  }
  horizon.statistics.work_budget = budget;
  Decider decider(terrain, *sweep, watch);
  PredicateCounts& counts = horizon.statistics.predicates;
  bool goes_on = decider.DecideAll(options.threads, budget, counts);
  if (goes_on && decider.undecided() > 0) {
    if (!options.approximate) return OverBudget(budget, sweep->candidates.size());
    goes_on = decider.DecideSome(options.threads, budget, counts);
  }
  if (!goes_on) return Error{ErrorCode::kCancelled, "stopped while deciding horizon edges"};
  horizon.statistics.undecided = decider.undecided();
  decider.AppendEdges(horizon);
  Check(!kinetic || horizon.edges.size() == sweep->candidates.size(),
        "every edge of the kinetic engine has a line of sight");
  for (const HorizonEdge& e : horizon.edges) {
    if (!e.witness.exact) return TooNarrow(terrain, e.edge);
    Check(!kinetic || e.undecided || WitnessHolds(terrain, e.edge, e.witness),
          "a line of sight over the kinetic engine's edges is one over the terrain");
  }
  return horizon;
}

}  // namespace farhorizon
