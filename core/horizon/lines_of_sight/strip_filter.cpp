#include "core/horizon/lines_of_sight/strip_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace farhorizon {
namespace {

using Kind = BoundaryCurve::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

StripFilter::StripFilter(const TargetSegment& edge)
    : edge_(edge),
      run_x_(static_cast<double>(edge.high.x) - edge.low.x),
      run_y_(static_cast<double>(edge.high.y) - edge.low.y),
      length_squared_(run_x_ * run_x_ + run_y_ * run_y_) {}

StripFilter::SlopeRange StripFilter::SlopesOf(const BoundaryCurve& curve, double t) const {
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
  const double error = 0x1p-46 * (std::abs(run_x_) + std::abs(run_y_)) * size;
  const double across = run_x_ * y - run_y_ * x;
  if (across < 4 * error) return {-kInfinity, kInfinity};
  const double slope = -(run_x_ * x + run_y_ * y) / across;
  const double margin = 4 * error / across * (1 + std::abs(slope));
  return {slope - margin, slope + margin};
}

StripFilter::Cell StripFilter::Of(const StripCell& cell) const {
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
StripFilter::Shade StripFilter::ShadeOf(const std::array<Corner, N>& corners) const {
  constexpr Shade kAnything{-kInfinity, kInfinity};
  // Least and greatest slope on each side of the edge's line.
  SlopeRange left{kInfinity, -kInfinity};
  SlopeRange right{kInfinity, -kInfinity};
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
    SlopeRange& side = c.across > 0 ? left : right;
    for (const double slope : {-c.along / c.across, (length_squared_ - c.along) / c.across}) {
      const double margin = 1e-12 * (1 + std::abs(slope));
      side.from = std::min(side.from, slope - margin);
      side.to = std::max(side.to, slope + margin);
    }
  }
  const bool on_left = left.from <= left.to;
  const bool on_right = right.from <= right.to;
  across = across || (on_left && on_right);
  if (!across) return on_left ? Shade{left.from, left.to} : Shade{right.from, right.to};
  if (ahead) return {on_left ? left.to : -kInfinity, on_right ? right.from : kInfinity, true};
  if (behind) return {on_right ? right.to : -kInfinity, on_left ? left.from : kInfinity, true};
  return kAnything;
}

template <std::size_t N>
bool StripFilter::IsBeside(const std::array<Corner, N>& corners, const StripCell& cell, double from,
                           double to) const {
  const auto at = [this](const Corner& c, double t) -> PlanVector {
    const PlanVector v{c.x - run_x_ * t, c.y - run_y_ * t};
    return c.across > 0 ? v : PlanVector{-v.x, -v.y};
  };
  const auto sweep = [](const BoundaryCurve& curve, double t0, double t1) {
    return VectorRangeOf(curve.v, t0, t1);
  };
  const VectorRange first = sweep(cell.first, from, to);
  const VectorRange last = sweep(cell.last, from, to);
  bool left = false;
  bool right = false;
  bool ahead = true;
  bool behind = true;
  bool before[2] = {cell.first.kind != Kind::kAlong, cell.first.kind != Kind::kAlong};
  bool past[2] = {cell.last.kind != Kind::kAgainst, cell.last.kind != Kind::kAgainst};
  for (const Corner& c : corners) {
    ahead = ahead && c.along > length_squared_;
    behind = behind && c.along < 0;
    left = left || c.across >= 0;
    right = right || c.across <= 0;
    if (c.across == 0) continue;
    const std::size_t side = c.across > 0 ? 0 : 1;
    const VectorRange v{at(c, from), at(c, to), std::abs(c.x) + std::abs(c.y) + length_squared_};
    before[side] = before[side] && SurelyTurns(v, first);
    past[side] = past[side] && SurelyTurns(last, v);
    if (!before[side] && !past[side]) return false;
  }
  if (!right) return before[0] || past[0];
  if (!left) return before[1] || past[1];
  return (ahead && before[0] && past[1]) || (behind && past[0] && before[1]);
}

template StripFilter::Shade StripFilter::ShadeOf(const std::array<Corner, 2>&) const;
template StripFilter::Shade StripFilter::ShadeOf(const std::array<Corner, 4>&) const;
template bool StripFilter::IsBeside(const std::array<Corner, 2>&, const StripCell&, double,
                                    double) const;
template bool StripFilter::IsBeside(const std::array<Corner, 4>&, const StripCell&, double,
                                    double) const;

double StripFilter::Reach(double top) const {
  const double climb = static_cast<double>(edge_.high.z) - edge_.low.z;
  return top < edge_.high.z ? (top - edge_.low.z) / climb + 0x1p-30 : 1;
}

}  // namespace farhorizon
