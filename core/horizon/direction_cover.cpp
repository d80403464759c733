#include "core/horizon/direction_cover.h"

#include <algorithm>

namespace farhorizon {
namespace {

// Positions are good to 1e-10, so from a twentieth of a cell away keys are to 4e-9.
constexpr double kPruneMargin = 1e-8;

constexpr double kHalfTurn = 2;
// Keys that only intervals reach which begin at the start, or end at the end, of the half turn.
constexpr double kBeforeStart = -1;
constexpr double kPastEnd = 3;

template <typename Int>
bool IsFirst(const BasicDirection<Int>& d) {
  return SignOf(d.v.y) == 0 && SignOf(d.v.x) > 0;
}
template <typename Int>
bool IsLast(const BasicDirection<Int>& d) {
  return SignOf(d.v.y) == 0 && SignOf(d.v.x) < 0;
}

}  // namespace

template <typename Int>
void BasicDirectionCover<Int>::Add(const Direction& from, const Direction& to, bool crosses_start,
                                   PredicateCounts* counts) {
  if (complete_) return;
  if (crosses_start) {
    AddInterval(from, LastDirection<Int>(), counts);
    AddInterval(FirstDirection<Int>(), to, counts);
  } else {
    AddInterval(from, to, counts);
  }
  complete_ = intervals_.size() == 1 && IsFirst(intervals_[0].from) && IsLast(intervals_[0].to);
}

template <typename Int>
void BasicDirectionCover<Int>::AddInterval(const Direction& from, const Direction& to,
                                           PredicateCounts* counts) {
  // The intervals that the new one touches, first..last, become one with it.
  std::size_t first = 0;
  while (first < intervals_.size() && CompareAngle(intervals_[first].to, from, counts) < 0) ++first;
  std::size_t last = first;
  while (last < intervals_.size() && CompareAngle(intervals_[last].from, to, counts) <= 0) ++last;
  Interval merged{from, to, 0, 0};
  if (first < last) {
    if (CompareAngle(intervals_[first].from, from, counts) < 0)
      merged.from = intervals_[first].from;
    if (CompareAngle(intervals_[last - 1].to, to, counts) > 0) merged.to = intervals_[last - 1].to;
  }
  merged.from_bound = IsFirst(merged.from) ? kBeforeStart : merged.from.key;
  merged.to_bound = IsLast(merged.to) ? kPastEnd : merged.to.key;
  const auto at = intervals_.begin() + static_cast<std::ptrdiff_t>(first);
  if (first == last) {
    intervals_.insert(at, merged);
  } else {
    *at = merged;
    intervals_.erase(at + 1, intervals_.begin() + static_cast<std::ptrdiff_t>(last));
  }
}

template <typename Int>
bool BasicDirectionCover<Int>::SurelyCoversPart(double from_key, double to_key) const {
  return std::any_of(intervals_.begin(), intervals_.end(), [&](const Interval& interval) {
    return interval.from_bound <= from_key && to_key <= interval.to_bound;
  });
}

template <typename Int>
bool BasicDirectionCover<Int>::SurelyCovers(double from_key, double to_key) const {
  if (complete_) return true;
  // Widened by the margin, which may take the range across the start.
  double from = from_key - kPruneMargin;
  double to = to_key + kPruneMargin;
  if (from_key <= to_key) {
    if (from >= 0 && to <= kHalfTurn) return SurelyCoversPart(from, to);
    if (from < 0) from += kHalfTurn;
    if (to > kHalfTurn) to -= kHalfTurn;
  }
  return to < from && SurelyCoversPart(from, kPastEnd) && SurelyCoversPart(kBeforeStart, to);
}

template <typename Int>
std::optional<typename BasicDirectionCover<Int>::Gap> BasicDirectionCover<Int>::WidestGap() const {
  if (complete_) return std::nullopt;
  if (intervals_.empty()) return Gap{FirstDirection<Int>().v, LastDirection<Int>().v};
  const Interval& last = intervals_.back();
  // The gap across the start, unless an interval reaches it (then none does or both do).
  std::optional<Gap> widest;
  double width = -1;
  if (!IsLast(last.to) || !IsFirst(intervals_.front().from)) {
    widest = Gap{last.to.v, -intervals_.front().from.v};
    width = 2 - last.to.key + intervals_.front().from.key;
  }
  for (std::size_t i = 0; i + 1 < intervals_.size(); ++i) {
    const double between = intervals_[i + 1].from.key - intervals_[i].to.key;
    if (between > width) {
      width = between;
      widest = Gap{intervals_[i].to.v, intervals_[i + 1].from.v};
    }
  }
  return widest;
}

template class BasicDirectionCover<std::int64_t>;
template class BasicDirectionCover<Int128>;
template class BasicDirectionCover<WideInt>;

}  // namespace farhorizon
