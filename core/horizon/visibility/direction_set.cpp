// A set of directions as disjoint arcs, exact, and a copy of its gaps in doubles, for pruning.
// A line through the point of view has a direction of a free arc exactly if it lies between the two
// lines that bound the arc. So a box or segment has no point in such a direction if it lies on one
// side of both lines:
//
//                   to \  free  / from
//                       \      /   [box]       on the right of both: not in a free direction
//                        \    /
//                         \  /
//                          p               Cost: O(arcs) an operation.
#include "core/horizon/visibility/direction_set.h"

#include <algorithm>
#include <cmath>

namespace farhorizon {

namespace {

// How far from a bounding line a point must be for its side to be certain, in posts. A component of
// a UnitVector is off by less than 2^-49: a key is off by less than 2^-50 (direction.h), and each
// component takes one more rounding. With coordinates below 2^17 that are 10^-8 off, a cross
// product is off by less than 2 * (2^17 * 2^-49 + 10^-8) and some roundings of 2^-36: in all less
// than 3 * 10^-8. The margin is above this bound, and costs nothing where posts are 1 apart.
constexpr double kSideMargin = 1e-6;

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
    AddWithinHalfTurn(from, LastDirection<Int>(), counts);
    AddWithinHalfTurn(FirstDirection<Int>(), to, counts);
  } else {
    AddWithinHalfTurn(from, to, counts);
  }
  complete_ = arcs_.size() == 1 && IsFirst(arcs_[0].from) && IsLast(arcs_[0].to);
  UpdateFreeArcs();
}

template <typename Int>
void BasicDirectionSet<Int>::AddWithinHalfTurn(const Direction& from, const Direction& to,
                                               PredicateCounts* counts) {
  // The arcs that the new one touches, first up to last, become one arc with it.
  std::size_t first = 0;
  while (first < arcs_.size() && CompareAngle(arcs_[first].to, from, counts) < 0) ++first;
  std::size_t last = first;
  while (last < arcs_.size() && CompareAngle(arcs_[last].from, to, counts) <= 0) ++last;
  Arc merged{from, to};
  if (first < last) {
    if (CompareAngle(arcs_[first].from, from, counts) < 0) merged.from = arcs_[first].from;
    if (CompareAngle(arcs_[last - 1].to, to, counts) > 0) merged.to = arcs_[last - 1].to;
  }
  const auto at = arcs_.begin() + static_cast<std::ptrdiff_t>(first);
  if (first == last) {
    arcs_.insert(at, merged);
  } else {
    *at = merged;
    arcs_.erase(at + 1, arcs_.begin() + static_cast<std::ptrdiff_t>(last));
  }
}

template <typename Int>
typename BasicDirectionSet<Int>::UnitVector BasicDirectionSet<Int>::UnitVectorOf(
    const Direction& direction) {
  // The key is 1 - x of the vector in this direction with |x| + |y| = 1 and y >= 0.
  const double x = 1 - direction.key;
  return {x, 1 - std::abs(x)};
}

template <typename Int>
void BasicDirectionSet<Int>::UpdateFreeArcs() {
  free_arcs_.clear();
  for (std::size_t i = 0; i + 1 < arcs_.size(); ++i) {
    free_arcs_.push_back({UnitVectorOf(arcs_[i].to), UnitVectorOf(arcs_[i + 1].from)});
  }
  const Arc& last = arcs_.back();
  if (!IsLast(last.to) || !IsFirst(arcs_.front().from)) {
    const UnitVector beyond_start = UnitVectorOf(arcs_.front().from);
    free_arcs_.push_back({UnitVectorOf(last.to), {-beyond_start.x, -beyond_start.y}});
  }
}

template <typename Int>
bool BasicDirectionSet<Int>::SurelyContains(const PlanBox& box) const {
  if (arcs_.empty()) return false;
  const auto side_of = [&box](const UnitVector& u) -> int {
    const double center = u.x * box.center_y - u.y * box.center_x;
    const double reach =
        std::abs(u.x) * box.half_height + std::abs(u.y) * box.half_width + kSideMargin;
    return static_cast<int>(center > reach) - static_cast<int>(center < -reach);
  };
  return std::all_of(free_arcs_.begin(), free_arcs_.end(),
                     [&side_of](const ApproximateFreeArc& arc) {
                       const int side = side_of(arc.from);
                       return side != 0 && side_of(arc.to) == side;
                     });
}

template <typename Int>
bool BasicDirectionSet<Int>::SurelyContains(const PlanSegment& segment) const {
  if (arcs_.empty()) return false;
  const auto side_of = [&segment](const UnitVector& u) -> int {
    const double from = u.x * segment.from_y - u.y * segment.from_x;
    const double to = u.x * segment.to_y - u.y * segment.to_x;
    return static_cast<int>(std::min(from, to) > kSideMargin) -
           static_cast<int>(std::max(from, to) < -kSideMargin);
  };
  return std::all_of(free_arcs_.begin(), free_arcs_.end(),
                     [&side_of](const ApproximateFreeArc& arc) {
                       const int side = side_of(arc.from);
                       return side != 0 && side_of(arc.to) == side;
                     });
}

template <typename Int>
std::optional<typename BasicDirectionSet<Int>::FreeArc> BasicDirectionSet<Int>::WidestFreeArc()
    const {
  if (complete_) return std::nullopt;
  if (arcs_.empty()) return FreeArc{FirstDirection<Int>().v, LastDirection<Int>().v};
  const Arc& last = arcs_.back();
  // The free arc across the start, unless an arc of the set reaches the start; then arcs reach it
  // from both sides or from neither.
  std::optional<FreeArc> widest;
  double width = -1;
  if (!IsLast(last.to) || !IsFirst(arcs_.front().from)) {
    widest = FreeArc{last.to.v, -arcs_.front().from.v};
    width = 2 - last.to.key + arcs_.front().from.key;
  }
  for (std::size_t i = 0; i + 1 < arcs_.size(); ++i) {
    const double between = arcs_[i + 1].from.key - arcs_[i].to.key;
    if (between > width) {
      width = between;
      widest = FreeArc{arcs_[i].to.v, arcs_[i + 1].from.v};
    }
  }
  return widest;
}

template class BasicDirectionSet<std::int64_t>;
template class BasicDirectionSet<Int128>;
template class BasicDirectionSet<Int1280>;

}  // namespace farhorizon
