// Candidates are decided in batches, which threads take in turn. Nothing that a batch learns
// reaches another batch, so answers and counts do not depend on the threads.
#include "core/horizon/candidate_decider.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/parallel_for.h"
#include "core/horizon/visibility/face_wedge.h"

namespace farhorizon {

CandidateDecider::CandidateDecider(const Terrain& terrain, const Candidates& candidates,
                                   const RunControl& control)
    : terrain_(terrain),
      candidates_(candidates),
      control_(control),
      occluders_(terrain.dem().columns, terrain.dem().rows),
      witnesses_(candidates.edges.size()),
      decided_(candidates.edges.size(), 0),
      undecided_(candidates.edges.size()) {
  std::iota(undecided_.begin(), undecided_.end(), std::size_t{0});
  for (const Candidate& candidate : candidates_.edges) occluders_.Insert(SegmentOf(candidate));
}

bool CandidateDecider::DecideAll(int threads, std::int64_t budget, double share) {
  DecideRound(threads, {budget, budget}, share);
  if (spent_ <= budget) undecided_.clear();
  return !control_.StopRequested();
}

bool CandidateDecider::DecideSome(int threads, std::int64_t budget) {
  counts_ = {};
  std::fill(decided_.begin(), decided_.end(), 0);
  for (std::int64_t share = 0; !undecided_.empty() && !control_.StopRequested();) {
    const std::int64_t next =
        (budget - counts_.Sum()) / static_cast<std::int64_t>(undecided_.size());
    if (next < std::max<std::int64_t>(2 * share, 1)) break;
    share = next;
    // How many rounds there will be is not known: each is half of what is left.
    DecideRound(threads, {share, std::numeric_limits<std::int64_t>::max()}, (done_ + 1) / 2);
    std::erase_if(undecided_, [this](std::size_t i) { return decided_[i] != 0; });
  }
  return !control_.StopRequested();
}

void CandidateDecider::AppendEdges(Horizon& horizon) const {
  std::size_t kept = 0;
  std::size_t virtual_occluders = 0;
  for (std::size_t i = 0; i < candidates_.edges.size(); ++i) {
    if (!IsKept(i)) continue;
    ++kept;
    virtual_occluders += candidates_.OccludersOf(candidates_.edges[i]).size();
  }
  horizon.edges.reserve(kept);
  horizon.virtual_occluders.Reserve(kept, virtual_occluders);
  for (std::size_t i = 0; i < candidates_.edges.size(); ++i) {
    if (!IsKept(i)) continue;
    const Candidate& candidate = candidates_.edges[i];
    const bool undecided = decided_[i] == 0;
    const std::optional<Witness>& witness = witnesses_[i];
    horizon.edges.push_back({candidate.edge, undecided ? Witness{} : witness.value(), undecided});
    horizon.virtual_occluders.Append(candidates_.OccludersOf(candidate));
  }
}

void CandidateDecider::DecideRound(int threads, Limits limits, double done) {
  spent_ = 0;
  std::vector<PredicateCounts> per_thread(static_cast<std::size_t>(std::max(threads, 1)));
  ParallelForBatches(undecided_.size(), kBatch, threads, Stage::kDecide,
                     control_.Between(done_, done),
                     [&](std::size_t begin, std::size_t end, std::size_t thread) {
                       if (spent_ > limits.all) return;
                       const PredicateCounts taken = DecideBatch(begin, end, limits.each);
                       spent_ += taken.Sum();
                       per_thread[thread] += taken;
                     });
  done_ = done;
  for (const PredicateCounts& counts : per_thread) counts_ += counts;
}

PredicateCounts CandidateDecider::DecideBatch(std::size_t begin, std::size_t end,
                                              std::int64_t limit) {
  PredicateCounts taken;
  // The occluders of one candidate are likely to occlude the next. They are not carried over to
  // another batch: which one a thread takes next depends on the other threads.
  std::vector<OccluderId> likely;
  for (std::size_t k = begin; k < end; ++k) {
    const std::size_t i = undecided_[k];
    Visibility answer = Decide(i, likely, limit);
    taken += answer.counts;
    witnesses_[i] = answer.witness;
    decided_[i] = answer.witness || !answer.gave_up ? 1 : 0;
    if (!answer.witness && !answer.occluders.empty()) likely = std::move(answer.occluders);
  }
  return taken;
}

Visibility CandidateDecider::Decide(std::size_t i, std::span<const OccluderId> likely,
                                    std::int64_t limit) {
  const Candidate& candidate = candidates_.edges[i];
  return occluders_.FindLineOfSight(
      {.segment = SegmentOf(candidate),
       .except = static_cast<OccluderId>(i),
       .hints = {.virtual_occluders = candidates_.OccludersOf(candidate),
                 .likely = likely,
                 .wedge = WedgeOf(terrain_, candidate.edge)},
       .decision_limit = limit,
       .want_occluders = true});
}

Segment CandidateDecider::SegmentOf(const Candidate& candidate) const {
  return {terrain_.Point(candidate.edge.a), terrain_.Point(candidate.edge.b)};
}

}  // namespace farhorizon
