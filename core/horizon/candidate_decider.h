#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/horizon/horizon.h"
#include "core/horizon/sweep/candidates.h"
#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Decides candidates, each by looking for a line of sight over all others: exactly, as they make the same
/// skyline as the terrain. The answers are the same for any number of threads.
class CandidateDecider {
 public:
  /// Requires: all three outlive it.
  CandidateDecider(const Terrain& terrain, const Candidates& candidates, const Watch& watch);

  /// Decides all, or leaves all undecided where that takes more than the budget: a sum, so that the
  /// threads do not matter. False where the watch said stop.
  /// share: of the stage's progress that this is; the rest is left to DecideSome.
  bool DecideAll(int threads, std::int64_t budget, PredicateCounts& counts, double share = 1);

  /// Decides what the budget suffices for. Every undecided candidate may take an equal share of what is
  /// left of it; what the easy ones leave over makes the next round's share larger, until none is
  /// undecided or it no longer doubles. False where the watch said stop.
  bool DecideSome(int threads, std::int64_t budget, PredicateCounts& counts);

  [[nodiscard]] std::int64_t undecided() const {
    return static_cast<std::int64_t>(undecided_.size());
  }

  /// Appends the edges that have a line of sight, or are undecided, and their virtual occluders.
  void AppendEdges(Horizon& horizon) const;

 private:
  struct Limits {
    std::int64_t each = 0;  ///< decisions about one candidate
    std::int64_t all = 0;   ///< about all of them
  };
  struct Blockers {
    std::vector<OccluderSet::Id> likely;  ///< of the last hidden candidate
    std::vector<OccluderSet::Id> found;
  };
  // Brings the stage's progress to `done`.
  void Round(int threads, Limits limits, PredicateCounts& counts, double done);
  void DecideBatch(std::size_t begin, std::size_t end, std::int64_t most, PredicateCounts& counts);
  /// It has a line of sight, or is undecided.
  [[nodiscard]] bool IsKept(std::size_t i) const { return decided_[i] == 0 || witnesses_[i]; }
  void Decide(std::size_t i, std::int64_t most, Blockers& blockers, PredicateCounts& counts);

  const Terrain& terrain_;
  const std::vector<Candidate>& candidates_;
  std::span<const Segment> virtual_occluders_;
  const Watch& watch_;
  OccluderSet occluders_;
  std::vector<std::optional<Witness>> witnesses_;
  std::vector<char> decided_;  ///< each its own byte: threads write side by side
  std::vector<std::size_t> undecided_;
  double done_ = 0;                     ///< of the stage's progress
  std::atomic<std::int64_t> spent_{0};  ///< decisions in this round
};

}  // namespace farhorizon
