#include "core/horizon/candidate_decider.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/parallel_for.h"
#include "core/horizon/visibility/face_wedge.h"

namespace farhorizon {

CandidateDecider::CandidateDecider(const Terrain& terrain, const Candidates& candidates,
                                   const Watch& watch)
    : terrain_(terrain),
      candidates_(candidates.edges),
      virtual_occluders_(candidates.virtual_occluders),
      watch_(watch),
      occluders_(terrain.dem().columns, terrain.dem().rows),
      witnesses_(candidates.edges.size()),
      decided_(candidates.edges.size(), 0),
      undecided_(candidates.edges.size()) {
  std::iota(undecided_.begin(), undecided_.end(), std::size_t{0});
  for (const Candidate& candidate : candidates_) {
    occluders_.Insert({terrain.Point(candidate.edge.a), terrain.Point(candidate.edge.b)});
  }
}

bool CandidateDecider::DecideAll(int threads, std::int64_t budget, PredicateCounts& counts,
                                 double share) {
  Round(threads, {budget, budget}, counts, share);
  if (spent_ <= budget) undecided_.clear();
  return !watch_.StopRequested();
}

bool CandidateDecider::DecideSome(int threads, std::int64_t budget, PredicateCounts& counts) {
  counts = {};
  std::fill(decided_.begin(), decided_.end(), 0);
  for (std::int64_t share = 0; !undecided_.empty() && !watch_.StopRequested();) {
    const std::int64_t next =
        (budget - counts.Sum()) / static_cast<std::int64_t>(undecided_.size());
    if (next < std::max<std::int64_t>(2 * share, 1)) break;
    share = next;
    // How many rounds there will be is not known: each is half of what is left.
    Round(threads, {share, std::numeric_limits<std::int64_t>::max()}, counts, (done_ + 1) / 2);
    std::erase_if(undecided_, [this](std::size_t i) { return decided_[i] != 0; });
  }
  return !watch_.StopRequested();
}

void CandidateDecider::AppendEdges(Horizon& horizon) const {
  std::size_t edges = horizon.edges.size();
  std::size_t virtual_occluders = horizon.virtual_occluders.size();
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (!IsKept(i)) continue;
    ++edges;
    virtual_occluders += candidates_[i].virtual_occluder_count;
  }
  horizon.edges.reserve(edges);
  horizon.virtual_occluders.reserve(virtual_occluders);
  horizon.virtual_occluder_ends.reserve(edges);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (!IsKept(i)) continue;
    const std::optional<Witness>& witness = witnesses_[i];
    const bool undecided = decided_[i] == 0;
    const Candidate& c = candidates_[i];
    horizon.edges.push_back({c.edge, undecided ? Witness{} : witness.value(), undecided});
    for (const Segment& virtual_occluder :
         virtual_occluders_.subspan(c.first_virtual_occluder, c.virtual_occluder_count)) {
      horizon.virtual_occluders.push_back(virtual_occluder);
    }
    horizon.virtual_occluder_ends.push_back(horizon.virtual_occluders.size());
  }
}

void CandidateDecider::Round(int threads, Limits limits, PredicateCounts& counts, double done) {
  spent_ = 0;
  std::vector<PredicateCounts> per_thread(static_cast<std::size_t>(std::max(threads, 1)));
  ParallelForBatches(undecided_.size(), kBatch, threads, Stage::kDecide,
                     watch_.Between(done_, done),
                     [&](std::size_t begin, std::size_t end, std::size_t thread) {
                       if (spent_ <= limits.all)
                         DecideBatch(begin, end, limits.each, per_thread[thread]);
                     });
  done_ = done;
  for (const PredicateCounts& c : per_thread) {
    counts.filtered += c.filtered;
    counts.exact += c.exact;
    counts.tied += c.tied;
  }
}

void CandidateDecider::DecideBatch(std::size_t begin, std::size_t end, std::int64_t most,
                                   PredicateCounts& counts) {
  // What hides one candidate is likely to hide the next. Never carried over from one batch to
  // another: who did that one depends on the threads.
  Blockers blockers;
  const std::int64_t before = counts.Sum();
  for (std::size_t k = begin; k < end; ++k) Decide(undecided_[k], most, blockers, counts);
  spent_ += counts.Sum() - before;
}

void CandidateDecider::Decide(std::size_t i, std::int64_t most, Blockers& blockers,
                              PredicateCounts& counts) {
  const Candidate& c = candidates_[i];
  const OcclusionHints hints{
      virtual_occluders_.subspan(c.first_virtual_occluder, c.virtual_occluder_count),
      blockers.likely, WedgeOf(terrain_, c.edge)};
  DecisionLimit limit{most};
  blockers.found.clear();
  witnesses_[i] = occluders_.FindLineOfSight({terrain_.Point(c.edge.a), terrain_.Point(c.edge.b)},
                                             Ties::kPass, static_cast<OccluderSet::Id>(i), hints,
                                             &blockers.found, &counts, &limit);
  decided_[i] = witnesses_[i] || !limit.reached ? 1 : 0;
  if (!witnesses_[i] && !blockers.found.empty()) std::swap(blockers.likely, blockers.found);
}

}  // namespace farhorizon
