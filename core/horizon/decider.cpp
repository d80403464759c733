#include "core/horizon/decider.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "core/horizon/batches.h"
#include "core/horizon/face_wedge.h"

namespace farhorizon {

CandidateDecider::CandidateDecider(const Terrain& terrain, const Candidates& candidates,
                                   const Watch& watch)
    : terrain_(terrain),
      candidates_(candidates.edges),
      screens_(candidates.screens),
      watch_(watch),
      skyline_(terrain.dem().columns, terrain.dem().rows),
      witnesses_(candidates.edges.size()),
      decided_(candidates.edges.size(), 0),
      undecided_(candidates.edges.size()) {
  std::iota(undecided_.begin(), undecided_.end(), std::size_t{0});
  for (const Candidate& candidate : candidates_) {
    skyline_.Insert({terrain.Point(candidate.edge.a), terrain.Point(candidate.edge.b)});
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
  std::size_t screens = horizon.screens.size();
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (!IsKept(i)) continue;
    ++edges;
    screens += candidates_[i].screen_count;
  }
  horizon.edges.reserve(edges);
  horizon.screens.reserve(screens);
  horizon.screen_ends.reserve(edges);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (!IsKept(i)) continue;
    const std::optional<Witness>& witness = witnesses_[i];
    const bool undecided = decided_[i] == 0;
    const Candidate& c = candidates_[i];
    horizon.edges.push_back({c.edge, undecided ? Witness{} : witness.value(), undecided});
    for (const Segment& screen : screens_.subspan(c.first_screen, c.screen_count)) {
      horizon.screens.push_back(screen);
    }
    horizon.screen_ends.push_back(horizon.screens.size());
  }
}

void CandidateDecider::Round(int threads, Limits limits, PredicateCounts& counts, double done) {
  spent_ = 0;
  std::vector<PredicateCounts> per_thread(static_cast<std::size_t>(std::max(threads, 1)));
  ForEachBatch(undecided_.size(), kBatch, threads, Stage::kDecide, watch_.Between(done_, done),
               [&](std::size_t begin, std::size_t end, std::size_t thread) {
                 if (spent_ <= limits.all) DecideBatch(begin, end, limits.each, per_thread[thread]);
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
  const SightHints hints{screens_.subspan(c.first_screen, c.screen_count), blockers.likely,
                         WedgeOf(terrain_, c.edge)};
  SightLimit limit{most};
  blockers.found.clear();
  witnesses_[i] =
      skyline_.FindSight({terrain_.Point(c.edge.a), terrain_.Point(c.edge.b)}, Ties::kPass,
                         static_cast<Skyline::Id>(i), hints, &blockers.found, &counts, &limit);
  decided_[i] = witnesses_[i] || !limit.reached ? 1 : 0;
  if (!witnesses_[i] && !blockers.found.empty()) std::swap(blockers.likely, blockers.found);
}

}  // namespace farhorizon
