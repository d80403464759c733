#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/work_budget.h"

namespace farhorizon {

/// Work on many items of which each may take much or little, within a budget.
struct BudgetedWork {
  /// What an attempt has done: the decisions that it took, and those of its items that it left open
  /// because they reached the limit, rising.
  struct Done {
    std::int64_t spent = 0;
    std::vector<std::size_t> open = {};
  };
  /// Works on each of the items, rising numbers, and ends the work on one that has taken `limit`
  /// decisions. A new attempt on an item begins anew.
  /// Requires: nothing but the arguments matters for what is done; threads may call it at once for
  /// different items.
  using Attempt = std::function<Done(std::span<const std::size_t> items, std::int64_t limit)>;

  std::size_t count = 0;  ///< the items are 0 to count - 1
  Attempt attempt = {};
  Stage stage = Stage::kDecide;  ///< reports to this one
  /// For errors: what is being done, as in "finding lines of sight of 12 edges".
  std::string what = {};
  /// Where the budget is short: the share of what is left that this work may take. Later stages
  /// share the rest.
  double share = 1;
  /// Called before all items are begun anew: what the attempts so far have counted does not count.
  std::function<void()> restart = {};
};

/// The error of a run whose budget is exceeded: kResourceExhausted, kind work-budget. what: what it
/// was doing, as BudgetedWork has it.
Error OverBudget(const std::string& what, const WorkBudget& budget);

/// Works on all items and returns those that stay open, rising: none, unless the budget is
/// approximate and does not suffice.
///
/// At first each item may take all that is left. Where all of them together take more, and the
/// budget is approximate, they are begun anew in rounds: in each, every open item may take an equal
/// part of what is left. Rounds end when no item is open or the part is less than twice that of the
/// round before. The same for any number of threads.
/// Errors: kCancelled; kResourceExhausted, kind work-budget, where the budget is exceeded and not
/// approximate.
Result<std::vector<std::size_t>> WorkThrough(const BudgetedWork& work, int threads,
                                             WorkBudget& budget, const RunControl& control);

}  // namespace farhorizon
