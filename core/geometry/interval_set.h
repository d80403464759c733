#pragma once

#include <algorithm>
#include <array>
#include <vector>

namespace farhorizon {

/// A closed interval of numbers, [from, to]. Requires: from <= to, no NaN.
using Interval = std::array<double, 2>;

/// The union of intervals as disjoint ones, rising: those that overlap or touch become one.
/// Cost: O(n log n).
inline std::vector<Interval> UnionOf(std::vector<Interval> intervals) {
  std::sort(intervals.begin(), intervals.end());
  std::vector<Interval> disjoint;
  for (const Interval& next : intervals) {
    if (disjoint.empty() || next[0] > disjoint.back()[1]) {
      disjoint.push_back(next);
    } else {
      disjoint.back()[1] = std::max(disjoint.back()[1], next[1]);
    }
  }
  return disjoint;
}

}  // namespace farhorizon
