// The items are worked on in batches, which threads take in turn. Nothing that one batch learns
// reaches another, so what is done does not depend on the threads. Whether the first pass exceeds
// the budget does not depend on them either: batches are left out only once it is exceeded.
#include "core/horizon/budgeted_work.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/parallel_for.h"

namespace farhorizon {

namespace {

// One piece of work while it is done.
class Rounds {
 public:
  Rounds(const BudgetedWork& work, int threads, WorkBudget& budget, const RunControl& control)
      : work_(work), threads_(threads), budget_(budget), control_(control), open_(work.count) {
    std::iota(open_.begin(), open_.end(), std::size_t{0});
  }

  // Every item may take all that is left and one decision more: one that is left open exceeds the
  // budget by itself. Then open() has no meaning. Progress goes to `done`.
  bool WorkOnAll(double done) { return Work(budget_.left() + 1, true, done); }

  bool WorkInRounds() {
    const auto allowed =
        static_cast<std::int64_t>(work_.share * static_cast<double>(budget_.left()));
    const std::int64_t end = budget_.spent() + allowed;
    for (std::int64_t part = 0; !open_.empty();) {
      const std::int64_t next = (end - budget_.spent()) / std::ssize(open_);
      if (next < std::max<std::int64_t>(2 * part, 1)) break;
      part = next;
      // How many rounds there will be is not known: each is half of what is left of the progress.
      if (!Work(part, false, (done_ + 1) / 2)) return false;
    }
    return true;
  }

  void Restart() {
    open_.resize(work_.count);
    std::iota(open_.begin(), open_.end(), std::size_t{0});
    if (work_.restart) work_.restart();
  }

  [[nodiscard]] std::vector<std::size_t>& open() { return open_; }

 private:
  // Each open item may take `limit`. ends: where the budget is exceeded. False where a stop was
  // requested.
  bool Work(std::int64_t limit, bool ends, double done) {
    std::vector<std::vector<std::size_t>> still_open((open_.size() + kBatch - 1) / kBatch);
    const auto work = [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
      if (ends && budget_.IsExceeded()) return;
      BudgetedWork::Done batch = work_.attempt(std::span(open_).subspan(begin, end - begin), limit);
      budget_.Spend(batch.spent);
      still_open[begin / kBatch] = std::move(batch.open);
    };
    if (!ParallelForBatches(open_.size(), kBatch, threads_, work_.stage,
                            control_.Between(done_, done), work)) {
      return false;
    }
    done_ = done;
    open_.clear();
    for (const std::vector<std::size_t>& batch : still_open) {
      open_.insert(open_.end(), batch.begin(), batch.end());
    }
    return true;
  }

  const BudgetedWork& work_;
  int threads_;
  WorkBudget& budget_;
  const RunControl& control_;
  std::vector<std::size_t> open_;
  double done_ = 0;  // of the stage's progress
};

}  // namespace

Error OverBudget(const std::string& what, const WorkBudget& budget) {
  return {ErrorCode::kResourceExhausted,
          what + " takes more than what is left of the work budget of " +
              std::to_string(budget.limit()) +
              " decisions: white noise and forests of spikes are hard without end; keep what stays "
              "undecided (approximate), raise the work budget, or smooth the heights",
          "work-budget"};
}

Result<std::vector<std::size_t>> WorkThrough(const BudgetedWork& work, int threads,
                                             WorkBudget& budget, const RunControl& control) {
  const Error stopped{ErrorCode::kCancelled, "stopped while " + work.what};
  Rounds rounds(work, threads, budget, control);
  if (!budget.IsShort()) {
    const std::int64_t before = budget.spent();
    if (!rounds.WorkOnAll(budget.approximate() ? 0.5 : 1)) return stopped;
    if (!budget.IsExceeded()) {
      control.Report(work.stage, 1);
      return std::vector<std::size_t>();
    }
    if (!budget.approximate()) return OverBudget(work.what, budget);
    budget.Rewind(before);
    rounds.Restart();
  }
  if (!rounds.WorkInRounds()) return stopped;
  control.Report(work.stage, 1);
  return std::move(rounds.open());
}

}  // namespace farhorizon
