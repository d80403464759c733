#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/budgeted_work.h"
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
  /// Requires: both outlive it.
  CandidateDecider(const Terrain& terrain, const Candidates& candidates);

  /// What of the options of FindHorizon matters here.
  struct Options {
    int threads = 1;
    double budget_share = 1;
  };
  /// Decides all candidates, or as many as WorkThrough can afford.
  /// Errors: those of WorkThrough. Requires: it is called once.
  Status Decide(const Options& options, WorkBudget& budget, const RunControl& control);

  /// Candidates that Decide left undecided.
  [[nodiscard]] std::int64_t undecided() const { return std::ssize(undecided_); }

  /// The decisions that were taken, except those that WorkThrough began anew.
  [[nodiscard]] const PredicateCounts& counts() const { return counts_; }

  /// Appends the edges that are visible or undecided, and their virtual occluders. A witness need
  /// not be exact.
  void AppendEdges(Horizon& horizon) const;

 private:
  BudgetedWork::Done DecideBatch(std::span<const std::size_t> batch, std::int64_t limit);
  Visibility Decide(std::size_t i, std::span<const OccluderId> likely, std::int64_t limit);
  [[nodiscard]] Segment SegmentOf(const Candidate& candidate) const;

  const Terrain& terrain_;
  const Candidates& candidates_;
  OccluderSet occluders_;  ///< the candidates, by their indices
  std::vector<std::optional<Witness>> witnesses_;
  std::vector<std::size_t> undecided_;  ///< rising
  std::mutex counts_mutex_;
  PredicateCounts counts_;
};

}  // namespace farhorizon
