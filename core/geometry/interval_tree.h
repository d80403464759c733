#pragma once

#include <cstdint>
#include <vector>

namespace farhorizon {

/// Closed intervals of numbers, built once to find those that hold a given number.
///
/// A balanced binary tree: a node keeps the intervals that hold its middle, sorted by rising start
/// and by falling end, and has a child for those below its middle and one for those above.
/// Cost: O(n log n) to build, O(n) memory, O(log n + found) a query.
class IntervalTree {
 public:
  /// The interval [from, to] and what stands for it in answers.
  struct Entry {
    double from = 0;
    double to = 0;
    std::int32_t id = 0;
  };

  /// Requires: from <= to, no NaN.
  explicit IntervalTree(std::vector<Entry> intervals);

  /// The ids of the intervals that hold x, in no particular order.
  [[nodiscard]] std::vector<std::int32_t> Holding(double x) const;

 private:
  static constexpr std::int32_t kNone = -1;
  struct Node {
    double middle = 0;
    std::size_t begin = 0;  // its intervals are [begin, end) of by_start_ and of by_end_
    std::size_t end = 0;
    std::int32_t lower = kNone;
    std::int32_t upper = kNone;
  };
  std::int32_t Build(std::vector<Entry> intervals);

  std::vector<Node> nodes_;
  std::vector<Entry> by_start_;
  std::vector<Entry> by_end_;
  std::int32_t root_;
};

}  // namespace farhorizon
