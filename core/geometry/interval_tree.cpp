// A centred interval tree: the intervals that hold the median of all ends stay in the root, those
// below it and those above it make the subtrees. On the way down to a number x, each node gives a
// prefix of its intervals, sorted by start where x is below its middle, by end where it is above.
#include "core/geometry/interval_tree.h"

#include <algorithm>
#include <utility>

namespace farhorizon {

namespace {

// The median of all ends: at most half of the intervals are wholly below it, as many above.
double MiddleOf(const std::vector<IntervalTree::Entry>& intervals) {
  std::vector<double> ends;
  ends.reserve(2 * intervals.size());
  for (const IntervalTree::Entry& interval : intervals) {
    ends.push_back(interval.from);
    ends.push_back(interval.to);
  }
  const auto middle = ends.begin() + static_cast<std::ptrdiff_t>(intervals.size());
  std::nth_element(ends.begin(), middle, ends.end());
  return *middle;
}

}  // namespace

IntervalTree::IntervalTree(std::vector<Entry> intervals) {
  by_start_.reserve(intervals.size());
  by_end_.reserve(intervals.size());
  root_ = Build(std::move(intervals));
}

// Recursion as deep as the tree is high, O(log n).
// NOLINTNEXTLINE(misc-no-recursion)
std::int32_t IntervalTree::Build(std::vector<Entry> intervals) {
  if (intervals.empty()) return kNone;
  Node node;
  node.middle = MiddleOf(intervals);
  std::vector<Entry> lower;
  std::vector<Entry> upper;
  node.begin = by_start_.size();
  for (const Entry& interval : intervals) {
    if (interval.to < node.middle) {
      lower.push_back(interval);
    } else if (interval.from > node.middle) {
      upper.push_back(interval);
    } else {
      by_start_.push_back(interval);
    }
  }
  intervals = {};
  node.end = by_start_.size();
  const auto begin = static_cast<std::ptrdiff_t>(node.begin);
  by_end_.insert(by_end_.end(), by_start_.begin() + begin, by_start_.end());
  std::sort(by_start_.begin() + begin, by_start_.end(),
            [](const Entry& a, const Entry& b) { return a.from < b.from; });
  std::sort(by_end_.begin() + begin, by_end_.end(),
            [](const Entry& a, const Entry& b) { return a.to > b.to; });
  node.lower = Build(std::move(lower));
  node.upper = Build(std::move(upper));
  nodes_.push_back(node);
  return static_cast<std::int32_t>(nodes_.size() - 1);
}

std::vector<std::int32_t> IntervalTree::Holding(double x) const {
  std::vector<std::int32_t> ids;
  for (std::int32_t at = root_; at != kNone;) {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    if (x < node.middle) {
      for (std::size_t i = node.begin; i < node.end && by_start_[i].from <= x; ++i) {
        ids.push_back(by_start_[i].id);
      }
      at = node.lower;
    } else {
      for (std::size_t i = node.begin; i < node.end && by_end_[i].to >= x; ++i) {
        ids.push_back(by_end_[i].id);
      }
      at = node.upper;
    }
  }
  return ids;
}

}  // namespace farhorizon
