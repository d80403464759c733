#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace farhorizon {

/// The work that one run may take to find horizon edges and what is said of each: one sum over all
/// stages and threads.
///
/// Unit: a decision, which is about an exact comparison of two directions (PredicateCounts), some
/// 10 to 100 ns. Stages that compare no directions count steps that take about as long.
/// The sum over a stage does not depend on the threads, and so neither does whether it is exceeded.
/// BudgetedWork (budgeted_work.h) divides a budget among many items.
class WorkBudget {
 public:
  /// approximate: what happens where the limit does not suffice. false: the run ends with an error.
  /// true: the run goes on and leaves open what it could not afford.
  /// limit: of more than kMost, kMost counts; of less than 0, 0.
  explicit WorkBudget(std::int64_t limit, bool approximate = false)
      : limit_(std::clamp<std::int64_t>(limit, 0, kMost)), approximate_(approximate) {}

  /// Far more than any run takes; sums of a few of them do not overflow.
  static constexpr std::int64_t kMost = std::int64_t{1} << 60;

  [[nodiscard]] std::int64_t limit() const { return limit_; }
  [[nodiscard]] bool approximate() const { return approximate_; }

  /// Any number of threads may call it at once.
  void Spend(std::int64_t decisions) { spent_.fetch_add(decisions, std::memory_order_relaxed); }
  [[nodiscard]] std::int64_t spent() const { return spent_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::int64_t left() const { return std::max<std::int64_t>(limit_ - spent(), 0); }
  [[nodiscard]] bool IsExceeded() const { return spent() > limit_; }

  /// Forgets what was spent beyond `spent`, because its results are thrown away. This happens once
  /// in a run, so a run takes twice its limit at most: see IsShort.
  void Rewind(std::int64_t spent) {
    spent_ = spent;
    short_ = true;
  }
  /// True after Rewind: the limit does not suffice for the whole run, so stages no longer try to
  /// finish all of their work before they divide what is left.
  [[nodiscard]] bool IsShort() const { return short_; }

 private:
  std::int64_t limit_;
  bool approximate_;
  bool short_ = false;
  std::atomic<std::int64_t> spent_{0};
};

}  // namespace farhorizon
