#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/horizon/sweep/candidates.h"
#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Decides which candidates are horizon edges: those that are visible over all other candidates,
/// which make the same skyline as the terrain (core/horizon/README.md, corollary 2a). Exact; the
/// answers are the same for any number of threads.
class CandidateDecider {
 public:
  /// Requires: all three outlive it.
  CandidateDecider(const Terrain& terrain, const Candidates& candidates, const RunControl& control);

  /// Decides all candidates, or, if that takes more decisions than `budget`, leaves all undecided.
  /// Decisions are summed over all threads, so their number does not matter.
  /// share: of the stage's progress that this is; the rest is left to DecideSome.
  /// False where a stop was requested.
  bool DecideAll(int threads, std::int64_t budget, double share = 1);

  /// Starts again and decides as many candidates as `budget` suffices for. In each round every
  /// undecided candidate may take an equal share of what is left of the budget. Rounds end when no
  /// candidate is undecided or the share is less than twice that of the round before.
  /// False where a stop was requested.
  bool DecideSome(int threads, std::int64_t budget);

  [[nodiscard]] std::int64_t undecided() const {
    return static_cast<std::int64_t>(undecided_.size());
  }

  /// The decisions that were taken, those of DecideAll left out once DecideSome was called.
  [[nodiscard]] const PredicateCounts& counts() const { return counts_; }

  /// Appends the edges that are visible or undecided, and their virtual occluders. A witness need
  /// not be exact.
  void AppendEdges(Horizon& horizon) const;

 private:
  struct Limits {
    std::int64_t each = 0;  ///< decisions about one candidate
    std::int64_t all = 0;   ///< about all of them
  };
  /// Brings the stage's progress to `done`.
  void DecideRound(int threads, Limits limits, double done);
  PredicateCounts DecideBatch(std::size_t begin, std::size_t end, std::int64_t limit);
  Visibility Decide(std::size_t i, std::span<const OccluderId> likely, std::int64_t limit);
  [[nodiscard]] Segment SegmentOf(const Candidate& candidate) const;
  /// Whether candidate i is visible or undecided.
  [[nodiscard]] bool IsKept(std::size_t i) const { return decided_[i] == 0 || witnesses_[i]; }

  const Terrain& terrain_;
  const Candidates& candidates_;
  const RunControl& control_;
  OccluderSet occluders_;  ///< the candidates, by their indices
  std::vector<std::optional<Witness>> witnesses_;
  std::vector<char> decided_;  ///< a byte each, so that threads can write side by side
  std::vector<std::size_t> undecided_;
  double done_ = 0;  ///< of the stage's progress
  PredicateCounts counts_;
  std::atomic<std::int64_t> spent_{0};  ///< decisions in this round
};

}  // namespace farhorizon
