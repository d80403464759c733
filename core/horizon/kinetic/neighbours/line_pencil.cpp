// Intervals of lines and a greedy cover of them, with exact orders: each two lines of a pencil, as
// directions counter-clockwise from the first and less than half a turn on, are in the order of
// their cross product, which is an orientation of the apex and two corners.
#include "core/horizon/kinetic/neighbours/line_pencil.h"

#include <algorithm>
#include <cmath>

#include "core/base/result.h"
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "core/horizon/kinetic/neighbours/frozen_hulls.h"

namespace farhorizon::kinetic {

// 1: b is after a, counter-clockwise; 0: they are one, for ever.
template <typename Hulls>
int LinePencil<Hulls>::Order(const Line& a, const Line& b) const {
  if (a.through == b.through && a.sign == b.sign) return 0;
  if (a.through == kFirst) return 1;
  if (b.through == kFirst) return -1;
  if (last_ == nullptr) {
    if (a.through == kLast) return -1;
    if (b.through == kLast) return 1;
  }
  return a.sign * b.sign * Orient(PathOf(a.through), PathOf(b.through));
}

// The corner from which all others are on one side, seen from the apex: on the left for sense 1, on
// the right for sense -1. Round the hull, the angle rises to the left one and falls to the right
// one, so that bisection finds where it turns; the walk at the end passes what is in line.
template <typename Hulls>
PointId LinePencil<Hulls>::ExtremeCorner(ClusterId c, int sense) const {
  const std::vector<PointId>& ring = hulls_.corners(c);
  const std::size_t n = ring.size();
  const auto order = [&](std::size_t i, std::size_t k) {
    return sense * Orient(hulls_.path(ring[i % n]), hulls_.path(ring[k % n]));
  };
  std::size_t a = 0;
  std::size_t b = n;
  bool rises_at_a = n > 4 && order(0, 1) > 0;
  while (n > 4 && b - a > 1) {
    const std::size_t middle = (a + b) / 2;
    const bool rises = order(middle, middle + 1) > 0;
    const int from_a = order(a, middle);
    // The least one is before the middle: on the way down and then up, or up, down and up again.
    const bool before = rises_at_a ? rises && from_a < 0 : rises || from_a > 0;
    if (before) {
      b = middle;
    } else {
      a = middle;
      rises_at_a = rises;
    }
  }
  std::size_t at = a;
  std::size_t steps = 0;
  while (order(at, at + 1) < 0) {
    at = (at + 1) % n;
    Check(++steps <= 2 * n, "the apex is outside the hull");
  }
  while (order(at, at + n - 1) < 0) {
    at = (at + n - 1) % n;
    Check(++steps <= 2 * n, "the apex is outside the hull");
  }
  return ring[at];
}

template <typename Hulls>
void LinePencil<Hulls>::Add(ClusterId c) {
  Seen seen;
  seen.hull = c;
  seen.right = ExtremeCorner(c, 1);
  seen.left = ExtremeCorner(c, -1);
  const auto side = [&](PointId p) {
    return OrientAfter(first_, apex_, hulls_.path(p), hulls_.now());
  };
  seen.right_side = side(seen.right);
  seen.left_side = side(seen.left);
  const std::size_t index = seen_.size();
  seen_.push_back(seen);
  const Line right{seen.right, seen.right_side};
  const Line left{seen.left, seen.left_side};
  const bool crosses = seen.right_side * seen.left_side < 0;
  if (seen.right_side == 0 && seen.left_side == 0) return;  // no width, in the first line
  if (crosses || seen.right_side == 0) {
    parts_.push_back({kFirstLine, left, index});
  }
  if (crosses || seen.left_side == 0) {
    parts_.push_back({right, kLastLine, index});
  } else if (seen.right_side == seen.left_side) {
    parts_.push_back({right, left, index});
  }
}

template <typename Hulls>
bool LinePencil<Hulls>::Has(ClusterId c) const {
  return std::any_of(seen_.begin(), seen_.end(), [c](const Seen& s) { return s.hull == c; });
}

template <typename Hulls>
std::optional<typename LinePencil<Hulls>::Gap> LinePencil<Hulls>::FindGap() {
  cover_.clear();
  cover_hulls_.clear();
  Line reach = kFirstLine;
  for (bool more = true; more;) {
    more = false;
    Line furthest = reach;
    std::size_t best = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Part& part = parts_[i];
      if (Order(furthest, part.to) <= 0 || Order(part.from, reach) < 0) continue;
      furthest = part.to;
      best = i;
      more = true;
    }
    if (!more) break;
    reach = furthest;
    cover_.push_back(best);
    cover_hulls_.push_back(seen_[parts_[best].seen].hull);
    if (Order(reach, kLastLine) <= 0) return std::nullopt;
  }
  Line to = kLastLine;
  for (const Part& part : parts_) {
    if (Order(reach, part.from) > 0 && Order(part.from, to) > 0) to = part.from;
  }
  return Gap{reach, to};
}

template <typename Hulls>
Aim LinePencil<Hulls>::AimOf(const Line& line) const {
  const SweepDepth& now = hulls_.now();
  Aim aim;
  int sign = line.sign;
  if (line.through == kFirst || (line.through == kLast && last_ == nullptr)) {
    aim = AimAt(first_, apex_, now);
    if (line.through == kLast) sign = -1;
  } else {
    aim = AimAt(apex_, PathOf(line.through), now);
  }
  return sign > 0 ? aim : Aim{-aim.x, -aim.y, aim.error};
}

// The sum of the two, or what is at a right angle to the first where they are nearly opposite. A
// gap that has just opened has no width in floating point; its lines are those beside the first.
template <typename Hulls>
std::optional<Aim> LinePencil<Hulls>::DirectionIn(const Gap& gap) const {
  constexpr double kSmall = 0x1p-30;  // times any extent, far below PlanBox::kMargin
  const Aim from = AimOf(gap.from);
  const Aim to = AimOf(gap.to);
  Aim middle{from.x + to.x, from.y + to.y, 0x1p-51};
  if (std::fabs(middle.x) + std::fabs(middle.y) < 0x1p-4) middle = {-from.y, from.x, 0x1p-51};
  const double size = std::fabs(middle.x) + std::fabs(middle.y);
  middle.x /= size;
  middle.y /= size;
  if (FilteredCrossSign(from, middle) > 0 && FilteredCrossSign(middle, to) > 0) return middle;
  if (from.error < kSmall) return from;
  return std::nullopt;
}

template <typename Hulls>
bool LinePencil<Hulls>::LastOccludes(const Aim& direction) const {
  const SweepDepth& now = hulls_.now();
  const Seen& seen = seen_.back();
  const int right = FilteredCrossSign(direction, AimAt(apex_, hulls_.path(seen.right), now));
  const int left = FilteredCrossSign(direction, AimAt(apex_, hulls_.path(seen.left), now));
  return right * left < 0;
}

template <typename Hulls>
std::optional<SweepDepth> LinePencil<Hulls>::FailureBefore(std::int64_t end) const {
  std::optional<SweepDepth> first;
  const std::int64_t last = end;
  const auto certify = [&](PointId through, const Seen& seen) {
    const MovingPoint& on = PathOf(through);
    const int right = Orient(on, hulls_.path(seen.right));
    const int left = Orient(on, hulls_.path(seen.left));
    if (right == 0 || left == 0) return;  // for ever
    Check(right != left, "a line of the cover meets its segment");
    for (const auto& [p, sign] : {std::pair(seen.right, right), std::pair(seen.left, left)}) {
      const std::optional<SweepDepth> at =
          TurnFailureAfter({apex_, on, hulls_.path(p)}, sign, hulls_.now(), end);
      if (at && (!first || Compare(*at, *first) < 0)) first = at;
    }
  };
  PointId through = kFirst;
  for (const std::size_t i : cover_) {
    const Seen& seen = seen_[parts_[i].seen];
    end = std::min({end, hulls_.EndOf(seen.right), hulls_.EndOf(seen.left)});
  }
  for (const std::size_t i : cover_) {
    const Seen& seen = seen_[parts_[i].seen];
    certify(through, seen);
    through = seen.left;
  }
  certify(last_ == nullptr ? kFirst : kLast, seen_[parts_[cover_.back()].seen]);
  if (!first && end < last) first = SweepDepth::At(end);
  return first;
}

template class LinePencil<KineticHulls>;
template class LinePencil<FrozenHulls>;

}  // namespace farhorizon::kinetic
