#include "core/horizon/direction_cover.h"

#include <algorithm>

namespace farhorizon {
namespace {

// Positions are good to 1e-10, so from a twentieth of a cell away keys are to 4e-9.
constexpr double kPruneMargin = 1e-8;

bool IsFirst(const Direction& d) { return d.v.y == 0 && d.v.x > 0; }
bool IsLast(const Direction& d) { return d.v.y == 0 && d.v.x < 0; }

}  // namespace

void DirectionCover::Add(const Direction& from, const Direction& to, bool crosses_start,
                         PredicateCounts* counts) {
  if (complete_) return;
  if (crosses_start) {
    AddInterval(from, LastDirection(), counts);
    AddInterval(FirstDirection(), to, counts);
  } else {
    AddInterval(from, to, counts);
  }
  complete_ = intervals_.size() == 1 && IsFirst(intervals_[0].from) && IsLast(intervals_[0].to);
}

void DirectionCover::AddInterval(const Direction& from, const Direction& to,
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
  merged.from_bound = IsFirst(merged.from) ? -1 : merged.from.key + kPruneMargin;
  merged.to_bound = IsLast(merged.to) ? 3 : merged.to.key - kPruneMargin;
  const auto at = intervals_.begin() + static_cast<std::ptrdiff_t>(first);
  if (first == last) {
    intervals_.insert(at, merged);
  } else {
    *at = merged;
    intervals_.erase(at + 1, intervals_.begin() + static_cast<std::ptrdiff_t>(last));
  }
}

bool DirectionCover::SurelyCoversPart(double from_key, double to_key) const {
  return std::any_of(intervals_.begin(), intervals_.end(), [&](const Interval& interval) {
    return interval.from_bound <= from_key && to_key <= interval.to_bound;
  });
}

bool DirectionCover::SurelyCovers(double from_key, double to_key) const {
  if (complete_) return true;
  if (from_key <= to_key) return SurelyCoversPart(from_key, to_key);
  return SurelyCoversPart(from_key, 2) && SurelyCoversPart(0, to_key);
}

std::optional<DirectionCover::Gap> DirectionCover::WidestGap() const {
  if (complete_) return std::nullopt;
  if (intervals_.empty()) return Gap{FirstDirection().v, LastDirection().v};
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

}  // namespace farhorizon
