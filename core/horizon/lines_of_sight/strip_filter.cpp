// Which occluders can be skipped. Seen from the edge's point at t, a corner at (along, across),
// both times the edge's length L, has the slope (t L^2 - along) / across: linear in t
// (core/horizon/README.md, theorem 6). So the values at t = 0 and t = 1 bound those at all t.
//
//           left: across > 0                       ahead: along > L^2
//              slopes rise with t                  behind: along < 0
//      low o----------------------> high  - - - the edge's line - - -
//           right: across < 0
//              slopes fall with t
//
// An occluder on one side of the line occludes slopes between those of its corners. One across the
// line, ahead of the edge or behind it, occludes both ends of the half turn: all slopes except
// those that lie between the slopes of its corners on the left and on the right. u = 2^-53.
#include "core/horizon/lines_of_sight/strip_filter.h"

#include <algorithm>
#include <cmath>

#include "core/base/infinity.h"

namespace farhorizon {

namespace {

using Kind = BoundaryCurve::Kind;

}  // namespace

StripFilter::StripFilter(const TargetSegment& edge)
    : edge_(edge),
      run_x_(static_cast<double>(edge.high.x) - edge.low.x),
      run_y_(static_cast<double>(edge.high.y) - edge.low.y),
      length_squared_(run_x_ * run_x_ + run_y_ * run_y_) {}

StripFilter::SlopeBounds StripFilter::SlopesOf(const BoundaryCurve& curve, double t) const {
  if (curve.kind == Kind::kAlong) return {-kInfinity, -kInfinity};
  if (curve.kind == Kind::kAgainst) return {kInfinity, kInfinity};
  const auto at = [t](std::int64_t c, std::int64_t d) {
    return static_cast<double>(c) + static_cast<double>(d) * t;
  };
  const MovingVector& v = curve.v;
  const double x = at(v.ax, v.bx);
  const double y = at(v.ay, v.by);
  const double size = std::abs(static_cast<double>(v.ax)) + std::abs(static_cast<double>(v.bx)) +
                      std::abs(static_cast<double>(v.ay)) + std::abs(static_cast<double>(v.by));
  // t is exact here, so that x and y are off by 2u of their terms, and the products of the runs
  // with them, the exact components along and across the edge, by e = 4u (|run_x| + |run_y|) size
  // at most. With across >= 128 e, as below, the quotient is off by e (1 + |slope|) / across, with
  // less than a third more for the error of |slope| itself and for the rounding of the division.
  // `error` is 32 e and the margin four times as wide, a hundred times what is needed. Wide margins
  // are sound, too: they send a few more occluders on to exact arithmetic.
  const double error = 0x1p-46 * (std::abs(run_x_) + std::abs(run_y_)) * size;
  const double across = run_x_ * y - run_y_ * x;
  if (across < 4 * error) return {-kInfinity, kInfinity};
  const double slope = -(run_x_ * x + run_y_ * y) / across;
  const double margin = 4 * error / across * (1 + std::abs(slope));
  return {slope - margin, slope + margin};
}

StripFilter::CellBounds StripFilter::BoundsOf(const StripCell& cell) const {
  // The brackets of the ends. A curve turns one way, so its extremes are at the ends of any range
  // on which it stays in the half turn; where it leaves that at an end, SlopesOf gives no bound.
  const double from_t = cell.from.lo;
  const double to_t = cell.to.hi;
  return {std::min(SlopesOf(cell.first, from_t).from, SlopesOf(cell.first, to_t).from),
          std::max(SlopesOf(cell.last, from_t).to, SlopesOf(cell.last, to_t).to), from_t, to_t};
}

StripFilter::Corner StripFilter::CornerAt(std::int32_t x, std::int32_t y) const {
  const double from_x = static_cast<double>(x) - edge_.low.x;
  const double from_y = static_cast<double>(y) - edge_.low.y;
  return {from_x, from_y, run_x_ * from_x + run_y_ * from_y, run_x_ * from_y - run_y_ * from_x};
}

template <std::size_t N>
StripFilter::OccludedSlopes StripFilter::OccludedSlopesOf(
    const std::array<Corner, N>& corners) const {
  constexpr OccludedSlopes kAll{-kInfinity, kInfinity};
  // Least and greatest slope on each side of the edge's line.
  SlopeBounds left{kInfinity, -kInfinity};
  SlopeBounds right{kInfinity, -kInfinity};
  bool ahead = true;
  bool behind = true;
  bool across = false;
  for (const Corner& c : corners) {
    ahead = ahead && c.along > length_squared_;
    behind = behind && c.along < 0;
    if (c.across == 0) {
      across = true;
      continue;
    }
    SlopeBounds& side = c.across > 0 ? left : right;
    for (const double slope : {-c.along / c.across, (length_squared_ - c.along) / c.across}) {
      // Numerators and denominators are integers below 2^36, so that only the division is rounded.
      // Any factor from 2u on is sound; a wider margin admits a few occluders that only touch.
      const double margin = 1e-12 * (1 + std::abs(slope));
      side.from = std::min(side.from, slope - margin);
      side.to = std::max(side.to, slope + margin);
    }
  }
  const bool on_left = left.from <= left.to;
  const bool on_right = right.from <= right.to;
  across = across || (on_left && on_right);
  if (!across) {
    return on_left ? OccludedSlopes{left.from, left.to} : OccludedSlopes{right.from, right.to};
  }
  if (ahead) return {on_left ? left.to : -kInfinity, on_right ? right.from : kInfinity, true};
  if (behind) return {on_right ? right.to : -kInfinity, on_left ? left.from : kInfinity, true};
  return kAll;
}

template <std::size_t N>
bool StripFilter::SurelyDisjoint(const std::array<Corner, N>& corners, const StripCell& cell,
                                 double from, double to) const {
  // From the edge's point at t to a corner, as a direction of the half turn.
  const auto at = [this](const Corner& c, double t) -> PlanVector {
    const PlanVector v{c.x - run_x_ * t, c.y - run_y_ * t};
    return c.across > 0 ? v : PlanVector{-v.x, -v.y};
  };
  const EndVectors first = EndVectorsOf(cell.first.v, from, to);
  const EndVectors last = EndVectorsOf(cell.last.v, from, to);
  bool left = false;
  bool right = false;
  bool ahead = true;
  bool behind = true;
  // For the corners on the left (0) and on the right (1): whether all their directions come before
  // the cell's, and whether all come past them.
  bool before[2] = {cell.first.kind != Kind::kAlong, cell.first.kind != Kind::kAlong};
  bool past[2] = {cell.last.kind != Kind::kAgainst, cell.last.kind != Kind::kAgainst};
  for (const Corner& c : corners) {
    ahead = ahead && c.along > length_squared_;
    behind = behind && c.along < 0;
    left = left || c.across >= 0;
    right = right || c.across <= 0;
    if (c.across == 0) continue;
    const std::size_t side = c.across > 0 ? 0 : 1;
    // |run| <= run^2, as runs are integers: so the size is what EndVectors asks for.
    const EndVectors v{at(c, from), at(c, to), std::abs(c.x) + std::abs(c.y) + length_squared_};
    before[side] = before[side] && SurelyCounterClockwise(v, first);
    past[side] = past[side] && SurelyCounterClockwise(last, v);
    if (!before[side] && !past[side]) return false;
  }
  if (!right) return before[0] || past[0];
  if (!left) return before[1] || past[1];
  // Across the line: ahead, what is on the left is next to the half turn's start and what is on the
  // right next to its end; behind, the other way round.
  return (ahead && before[0] && past[1]) || (behind && past[0] && before[1]);
}

template StripFilter::OccludedSlopes StripFilter::OccludedSlopesOf(
    const std::array<Corner, 2>&) const;
template StripFilter::OccludedSlopes StripFilter::OccludedSlopesOf(
    const std::array<Corner, 4>&) const;
template bool StripFilter::SurelyDisjoint(const std::array<Corner, 2>&, const StripCell&, double,
                                          double) const;
template bool StripFilter::SurelyDisjoint(const std::array<Corner, 4>&, const StripCell&, double,
                                          double) const;

double StripFilter::LastTBelow(double top) const {
  // Differences of heights are exact, so that the quotient, below 1, is off by u. Any allowance
  // from 2u on is sound; this one is the width of a root's bracket (kBracketBits).
  constexpr double kAllowance = 0x1p-30;
  const double climb = static_cast<double>(edge_.high.z) - edge_.low.z;
  return top < edge_.high.z ? (top - edge_.low.z) / climb + kAllowance : 1;
}

}  // namespace farhorizon
