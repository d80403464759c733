// Each candidate is asked for a line of sight over all candidates, which generate H. The budget's
// division among them is BudgetedWork's; here is what one batch does, and the set that comes out.
#include "core/horizon/candidate_decider.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/horizon/visibility/face_wedge.h"

namespace farhorizon {

CandidateDecider::CandidateDecider(const Terrain& terrain, const Candidates& candidates)
    : terrain_(terrain),
      candidates_(candidates),
      occluders_(terrain.dem().columns, terrain.dem().rows),
      witnesses_(candidates.edges.size()) {
  for (const Candidate& candidate : candidates_.edges) occluders_.Insert(SegmentOf(candidate));
}

Status CandidateDecider::Decide(const Options& options, WorkBudget& budget,
                                const RunControl& control) {
  const BudgetedWork work{
      .count = candidates_.edges.size(),
      .attempt = [this](std::span<const std::size_t> batch,
                        std::int64_t limit) { return DecideBatch(batch, limit); },
      .stage = Stage::kDecide,
      .what = "deciding " + std::to_string(candidates_.edges.size()) + " candidate edges",
      .share = options.budget_share,
      .restart =
          [this] {
            counts_ = {};
            std::fill(witnesses_.begin(), witnesses_.end(), std::nullopt);
          }};
  Result<std::vector<std::size_t>> undecided = WorkThrough(work, options.threads, budget, control);
  if (!undecided) return std::move(undecided.error());
  undecided_ = *std::move(undecided);
  return Ok{};
}

void CandidateDecider::AppendEdges(Horizon& horizon) const {
  std::size_t kept = undecided_.size();
  std::size_t virtual_occluders = 0;
  for (const std::optional<Witness>& witness : witnesses_) kept += witness ? 1U : 0U;
  for (std::size_t i = 0; i < candidates_.edges.size(); ++i) {
    if (witnesses_[i]) virtual_occluders += candidates_.edges[i].virtual_occluder_count;
  }
  horizon.edges.reserve(kept);
  horizon.virtual_occluders.Reserve(kept, virtual_occluders);
  auto next_undecided = undecided_.begin();
  for (std::size_t i = 0; i < candidates_.edges.size(); ++i) {
    const Candidate& candidate = candidates_.edges[i];
    const bool undecided = next_undecided != undecided_.end() && *next_undecided == i;
    if (undecided) ++next_undecided;
    if (!undecided && !witnesses_[i]) continue;
    horizon.edges.push_back({candidate.edge, undecided ? Witness{} : *witnesses_[i], undecided});
    horizon.virtual_occluders.Append(candidates_.OccludersOf(candidate));
  }
}

BudgetedWork::Done CandidateDecider::DecideBatch(std::span<const std::size_t> batch,
                                                 std::int64_t limit) {
  BudgetedWork::Done done;
  PredicateCounts taken;
  // The occluders of one candidate are likely to occlude the next. They are not carried over to
  // another batch: which one a thread takes next depends on the other threads.
  std::vector<OccluderId> likely;
  for (const std::size_t i : batch) {
    Visibility answer = Decide(i, likely, limit);
    taken += answer.counts;
    witnesses_[i] = answer.witness;
    if (!answer.witness && answer.gave_up) done.open.push_back(i);
    if (!answer.witness && !answer.occluders.empty()) likely = std::move(answer.occluders);
  }
  done.spent = taken.Sum();
  const std::lock_guard lock(counts_mutex_);
  counts_ += taken;
  return done;
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
