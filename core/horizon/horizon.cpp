// The exact set of edges on the distant horizon, definition D2 of [Archambault05]'s problem:
// creases that attain the greatest height over a line of sight on an open set of lines. The sweep
// (hull_sweep.h) leaves candidates, which contain every horizon edge and so make the same skyline
// as the whole terrain; each is then sighted over the others, exactly (skyline.h).
#include "core/horizon/horizon.h"

#include <algorithm>
#include <atomic>
#include <exception>
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
        witnesses_(sweep.candidates.size()) {
    for (const Candidate& candidate : candidates_) {
      skyline_.Insert({terrain.Point(candidate.edge.a), terrain.Point(candidate.edge.b)});
    }
  }

  /// False where the watch said stop.
  bool Run(int threads, PredicateCounts& counts) {
    std::vector<PredicateCounts> per_thread(static_cast<std::size_t>(std::max(threads, 1)));
    std::vector<std::exception_ptr> failures(per_thread.size());
    {
      std::vector<std::jthread> helpers;
      for (std::size_t i = 1; i < per_thread.size(); ++i) {
        helpers.emplace_back([this, i, &per_thread, &failures] {
          try {
            Work(per_thread[i], false);
          } catch (...) {
            failures[i] = std::current_exception();
          }
        });
      }
      Work(per_thread[0], true);
    }
    for (const std::exception_ptr& failure : failures) {
      if (failure) std::rethrow_exception(failure);
    }
    for (const PredicateCounts& c : per_thread) {
      counts.filtered += c.filtered;
      counts.exact += c.exact;
      counts.tied += c.tied;
    }
    return !watch_.StopRequested();
  }

  [[nodiscard]] std::vector<HorizonEdge> Edges() const {
    std::vector<HorizonEdge> edges;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (witnesses_[i]) edges.push_back({candidates_[i].edge, *witnesses_[i]});
    }
    return edges;
  }

 private:
  void Work(PredicateCounts& counts, bool reports) {
    // What hides one candidate is likely to hide the next. Never carried over from one batch to
    // another: who did that one depends on the threads.
    std::vector<Skyline::Id> likely;
    std::vector<Skyline::Id> blockers;
    while (!watch_.StopRequested()) {
      const std::size_t begin = next_.fetch_add(kBatch);
      if (begin >= candidates_.size()) return;
      const std::size_t end = std::min(begin + kBatch, candidates_.size());
      likely.clear();
      for (std::size_t i = begin; i < end; ++i) {
        const Candidate& c = candidates_[i];
        blockers.clear();
        witnesses_[i] =
            skyline_.FindSight({terrain_.Point(c.edge.a), terrain_.Point(c.edge.b)}, Ties::kPass,
                               static_cast<Skyline::Id>(i), &blockers, &counts,
                               screens_.subspan(c.first_screen, c.screen_count), likely);
        if (!witnesses_[i] && !blockers.empty()) std::swap(likely, blockers);
      }
      if (reports) {
        watch_.Report("decide", static_cast<double>(end) / static_cast<double>(candidates_.size()));
      }
    }
  }

  const Terrain& terrain_;
  const std::vector<Candidate>& candidates_;
  std::span<const Segment> screens_;
  const Watch& watch_;
  Skyline skyline_;
  std::vector<std::optional<Witness>> witnesses_;
  std::atomic<std::size_t> next_{0};
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

}  // namespace

namespace {

// Leaves of the candidates the edges that the kinetic engine finds: they make the same skyline as the
// terrain, so they do for obstacles, too.
Result<EventCounts> KeepKineticEdges(const Terrain& terrain, HullSweep& sweep, const Watch& watch) {
  Result<KineticHorizon> kinetic = FindHorizonKinetic(terrain, watch);
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

Result<Horizon> FindHorizon(const Terrain& terrain, int threads, const Watch& watch,
                            Engine engine) {
  Result<HullSweep> sweep = SweepHulls(terrain, watch);
  if (!sweep) return std::move(sweep.error());
  Horizon horizon;
  horizon.statistics = sweep->statistics;
  horizon.hulls = std::move(sweep->hulls);
  const bool kinetic = engine == Engine::kKinetic;
  if (kinetic) {
    Result<EventCounts> events = KeepKineticEdges(terrain, *sweep, watch);
    if (!events) return std::move(events.error());
    Tell(*events, horizon.statistics);
  }
  Decider decider(terrain, *sweep, watch);
  if (!decider.Run(threads, horizon.statistics.predicates)) {
    return Error{ErrorCode::kCancelled, "stopped while deciding horizon edges"};
  }
  horizon.edges = decider.Edges();
  Check(!kinetic || horizon.edges.size() == sweep->candidates.size(),
        "every edge of the kinetic engine has a line of sight");
  for (const HorizonEdge& e : horizon.edges) {
    if (!e.witness.exact) return TooNarrow(terrain, e.edge);
    Check(!kinetic || WitnessHolds(terrain, e.edge, e.witness),
          "a line of sight over the kinetic engine's edges is one over the terrain");
  }
  return horizon;
}

}  // namespace farhorizon
