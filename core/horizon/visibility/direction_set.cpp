#include "core/horizon/visibility/direction_set.h"

#include <algorithm>
#include <cmath>

namespace farhorizon {
namespace {

// Far above what rounding does to products of unit vectors and coordinates, far below a post.
constexpr double kPruneMargin = 1e-6;

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
void BasicDirectionSet<Int>::Add(const Direction& from, const Direction& to, bool crosses_start,
                                 PredicateCounts* counts) {
  if (complete_) return;
  if (crosses_start) {
    AddInterval(from, LastDirection<Int>(), counts);
    AddInterval(FirstDirection<Int>(), to, counts);
  } else {
    AddInterval(from, to, counts);
  }
  complete_ = intervals_.size() == 1 && IsFirst(intervals_[0].from) && IsLast(intervals_[0].to);
  FindOpenings();
}

template <typename Int>
void BasicDirectionSet<Int>::AddInterval(const Direction& from, const Direction& to,
                                         PredicateCounts* counts) {
  // The intervals that the new one touches, first..last, become one with it.
  std::size_t first = 0;
  while (first < intervals_.size() && CompareAngle(intervals_[first].to, from, counts) < 0) ++first;
  std::size_t last = first;
  while (last < intervals_.size() && CompareAngle(intervals_[last].from, to, counts) <= 0) ++last;
  Interval merged{from, to};
  if (first < last) {
    if (CompareAngle(intervals_[first].from, from, counts) < 0)
      merged.from = intervals_[first].from;
    if (CompareAngle(intervals_[last - 1].to, to, counts) > 0) merged.to = intervals_[last - 1].to;
  }
  const auto at = intervals_.begin() + static_cast<std::ptrdiff_t>(first);
  if (first == last) {
    intervals_.insert(at, merged);
  } else {
    *at = merged;
    intervals_.erase(at + 1, intervals_.begin() + static_cast<std::ptrdiff_t>(last));
  }
}

template <typename Int>
typename BasicDirectionSet<Int>::Ray BasicDirectionSet<Int>::RayOf(const Direction& direction) {
  // The key is 1 - x for the vector of its direction with |x| + |y| = 1, y >= 0.
  const double x = 1 - direction.key;
  return {x, 1 - std::abs(x)};
}

template <typename Int>
void BasicDirectionSet<Int>::FindOpenings() {
  openings_.clear();
  for (std::size_t i = 0; i + 1 < intervals_.size(); ++i) {
    openings_.push_back({RayOf(intervals_[i].to), RayOf(intervals_[i + 1].from)});
  }
  const Interval& last = intervals_.back();
  if (!IsLast(last.to) || !IsFirst(intervals_.front().from)) {
    const Ray across = RayOf(intervals_.front().from);
    openings_.push_back({RayOf(last.to), {-across.x, -across.y}});
  }
}

// What is on one side of both lines that bound an opening is seen beside it.

template <typename Int>
bool BasicDirectionSet<Int>::SurelyContains(const PlanBox& box) const {
  if (intervals_.empty()) return false;
  const auto beside = [&box](const Ray& ray) -> int {
    const double center = ray.x * box.center_y - ray.y * box.center_x;
    const double reach =
        std::abs(ray.x) * box.half_height + std::abs(ray.y) * box.half_width + kPruneMargin;
    return static_cast<int>(center > reach) - static_cast<int>(center < -reach);
  };
  return std::all_of(openings_.begin(), openings_.end(), [&beside](const Opening& opening) {
    const int side = beside(opening.from);
    return side != 0 && beside(opening.to) == side;
  });
}

template <typename Int>
bool BasicDirectionSet<Int>::SurelyContains(const PlanStroke& stroke) const {
  if (intervals_.empty()) return false;
  const auto beside = [&stroke](const Ray& ray) -> int {
    const double from = ray.x * stroke.from_y - ray.y * stroke.from_x;
    const double to = ray.x * stroke.to_y - ray.y * stroke.to_x;
    return static_cast<int>(std::min(from, to) > kPruneMargin) -
           static_cast<int>(std::max(from, to) < -kPruneMargin);
  };
  return std::all_of(openings_.begin(), openings_.end(), [&beside](const Opening& opening) {
    const int side = beside(opening.from);
    return side != 0 && beside(opening.to) == side;
  });
}

template <typename Int>
std::optional<typename BasicDirectionSet<Int>::Gap> BasicDirectionSet<Int>::WidestGap() const {
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

template class BasicDirectionSet<std::int64_t>;
template class BasicDirectionSet<Int128>;
template class BasicDirectionSet<Int1280>;

}  // namespace farhorizon
