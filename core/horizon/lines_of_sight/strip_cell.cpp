#include "core/horizon/lines_of_sight/strip_cell.h"

#include <algorithm>
#include <cmath>

namespace farhorizon {
namespace {

using Kind = BoundaryCurve::Kind;

// The cross product of two moving vectors at t in plain numbers, where that tells its sign.
std::optional<int> FilteredSign(const MovingVector& a, const MovingVector& b, double t) {
  // Each coordinate is within 2^-51 of the sum of its terms' sizes, the difference of products within
  // a little more than twice that.
  constexpr double kError = 0x1p-48;
  const auto at = [t](std::int64_t c, std::int64_t d) {
    return static_cast<double>(c) + static_cast<double>(d) * t;
  };
  const auto size = [](std::int64_t c, std::int64_t d) {
    return std::abs(static_cast<double>(c)) + std::abs(static_cast<double>(d));
  };
  const double cross = at(a.ax, a.bx) * at(b.ay, b.by) - at(a.ay, a.by) * at(b.ax, b.bx);
  const double most = size(a.ax, a.bx) * size(b.ay, b.by) + size(a.ay, a.by) * size(b.ax, b.bx);
  if (std::abs(cross) <= kError * most) return std::nullopt;
  return cross > 0 ? 1 : -1;
}

}  // namespace

int Order(const BoundaryCurve& a, const BoundaryCurve& b, const SamplePoint& point) {
  if (a.kind != b.kind) return a.kind < b.kind ? 1 : -1;
  if (a.kind != Kind::kMoving) return 0;
  if (const std::optional<int> sign = FilteredSign(a.v, b.v, point.ToDouble())) return *sign;
  return point.Sign(Cross(a.v, b.v));
}

VectorRange VectorRangeOf(const MovingVector& v, double from, double to) {
  const auto ax = static_cast<double>(v.ax);
  const auto ay = static_cast<double>(v.ay);
  const auto bx = static_cast<double>(v.bx);
  const auto by = static_cast<double>(v.by);
  return {{ax + bx * from, ay + by * from},
          {ax + bx * to, ay + by * to},
          std::abs(ax) + std::abs(ay) + std::abs(bx) + std::abs(by)};
}

bool SurelyTurns(const VectorRange& a, const VectorRange& b) {
  // The Bernstein coefficients of their cross product are positive.
  constexpr double kError = 0x1p-47;
  const double margin = kError * a.size * b.size;
  return Cross(a.start, b.start) > margin && Cross(a.end, b.end) > margin &&
         Cross(a.start, b.end) + Cross(a.end, b.start) > margin;
}

bool SurelyInOrder(const BoundaryCurve& a, const BoundaryCurve& b, double from, double to) {
  if (a.kind == Kind::kAlong || b.kind == Kind::kAgainst || a == b) return true;
  if (a.kind != Kind::kMoving || b.kind != Kind::kMoving) return false;
  return SurelyTurns(VectorRangeOf(a.v, from, to), VectorRangeOf(b.v, from, to));
}

void AppendCrossings(const BoundaryCurve& a, const BoundaryCurve& b, double from, double to,
                     std::vector<IsolatedRoot>& roots) {
  if (a.kind != Kind::kMoving || b.kind != Kind::kMoving || a == b) return;
  const VectorRange sweep_a = VectorRangeOf(a.v, from, to);
  const VectorRange sweep_b = VectorRangeOf(b.v, from, to);
  if (SurelyTurns(sweep_a, sweep_b) || SurelyTurns(sweep_b, sweep_a)) return;
  for (const IsolatedRoot& root : SignChanges(Cross(a.v, b.v))) roots.push_back(root);
}

std::vector<IsolatedRoot> Cuts(const IsolatedRoot& from, std::vector<IsolatedRoot> roots,
                               const IsolatedRoot& to) {
  std::vector<IsolatedRoot> cuts = {from};
  std::sort(roots.begin(), roots.end(),
            [](const IsolatedRoot& a, const IsolatedRoot& b) { return Compare(a, b) < 0; });
  for (const IsolatedRoot& root : roots) {
    if (Compare(cuts.back(), root) < 0 && Compare(root, to) < 0) cuts.push_back(root);
  }
  cuts.push_back(to);
  return cuts;
}

void StripBuilder::Add(const IsolatedRoot& from, const IsolatedRoot& to,
                       const std::vector<std::pair<BoundaryCurve, BoundaryCurve>>& columns) {
  std::vector<std::size_t> now;
  for (const auto& [first, last] : columns) {
    const auto same = std::find_if(open_.begin(), open_.end(), [&](std::size_t i) {
      return cells_[i].first == first && cells_[i].last == last;
    });
    if (same != open_.end()) {
      cells_[*same].to = to;
      now.push_back(*same);
    } else {
      now.push_back(cells_.size());
      cells_.push_back({from, to, first, last});
    }
  }
  open_ = std::move(now);
}

}  // namespace farhorizon
