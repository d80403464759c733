// Comparisons of boundary curves. Two curves a + b t cross where their cross product, a quadratic
// in t, changes its sign; between neighbouring roots one order of the two holds, and one sample
// tells it. Floating point decides where its error bound allows, else the quadratic is evaluated
// exactly. All bounds below hold for MovingVector's numbers: integers below 2^50, so exact in
// double. u = 2^-53.
#include "core/horizon/lines_of_sight/strip_cell.h"

#include <algorithm>
#include <cmath>

namespace farhorizon {

namespace {

using Kind = BoundaryCurve::Kind;

// The sign of the cross product of two moving vectors at t, where doubles can tell it.
std::optional<int> FilteredSign(const MovingVector& a, const MovingVector& b, double t) {
  // t is within u of the sample and below 1, so that a coordinate c + d t is off by at most 2u |d|
  // for t and the product, and u (|c| + |d|) for the sum: by less than 2^-51 of its size |c| + |d|.
  // A product of two coordinates is then off by 2 * 2^-51 + u of the product of their sizes, to
  // first order, and the difference of two such products by 2^-50 + 2u of `most`, which is below
  // 2^-49. A factor of two is left for terms of higher order and for the rounding of `most`.
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

PlanVector DirectionAt(const MovingVector& v, const IsolatedRoot& t) {
  // A double is within 2^-47 of t, so the vector is off by 2^-46.8 of its size, with the roundings
  // of products and sums. That is 2^-36.8 of its length where that is 2^-10 of its size.
  constexpr double kLeastLength = 0x1p-10;
  const EndVectors at = EndVectorsOf(v, t.ToDouble(), 0);
  const double length = std::hypot(at.start.x, at.start.y);
  if (t.lo == t.hi || length >= kLeastLength * at.size) return at.start;
  // The vector's tip moves on a line whose distance from 0 is |cross(a, b)| / |b| > 2^-51, for the
  // cross product is an integer. So 2^-144 for t is 2^(51 - 144 + 51) of the length at most.
  constexpr int kBits = 144;
  const BasicVector<Int1280> exact = v.At(Refined(t, kBits));
  return {static_cast<double>(exact.x), static_cast<double>(exact.y)};
}

EndVectors EndVectorsOf(const MovingVector& v, double from, double to) {
  const auto ax = static_cast<double>(v.ax);
  const auto ay = static_cast<double>(v.ay);
  const auto bx = static_cast<double>(v.bx);
  const auto by = static_cast<double>(v.by);
  return {{ax + bx * from, ay + by * from},
          {ax + bx * to, ay + by * to},
          std::abs(ax) + std::abs(ay) + std::abs(bx) + std::abs(by)};
}

bool SurelyCounterClockwise(const EndVectors& a, const EndVectors& b) {
  // Over the range the cross product is a quadratic with these three Bernstein coefficients, the
  // second one doubled. If all are positive, it is positive on the whole range.
  //
  // The ends of the range are exact, so that a coordinate is off by 2u of its part of the size. A
  // product of two coordinates is off by 5u of the product of their parts, a cross product by 6u
  // and the sum of two by 14u of the product of the sizes, to first order. That is below 2^-49; any
  // larger factor is sound, and leaves a few more pairs to exact arithmetic.
  constexpr double kError = 0x1p-47;
  const double margin = kError * a.size * b.size;
  return Cross(a.start, b.start) > margin && Cross(a.end, b.end) > margin &&
         Cross(a.start, b.end) + Cross(a.end, b.start) > margin;
}

bool SurelyInOrder(const BoundaryCurve& a, const BoundaryCurve& b, double from, double to) {
  if (a.kind == Kind::kAlong || b.kind == Kind::kAgainst || a == b) return true;
  if (a.kind != Kind::kMoving || b.kind != Kind::kMoving) return false;
  return SurelyCounterClockwise(EndVectorsOf(a.v, from, to), EndVectorsOf(b.v, from, to));
}

void AppendCrossings(const BoundaryCurve& a, const BoundaryCurve& b, double from, double to,
                     std::vector<IsolatedRoot>& roots) {
  if (a.kind != Kind::kMoving || b.kind != Kind::kMoving || a == b) return;
  const EndVectors ends_a = EndVectorsOf(a.v, from, to);
  const EndVectors ends_b = EndVectorsOf(b.v, from, to);
  if (SurelyCounterClockwise(ends_a, ends_b) || SurelyCounterClockwise(ends_b, ends_a)) return;
  for (const IsolatedRoot& root : SignChanges(Cross(a.v, b.v))) roots.push_back(root);
}

std::vector<IsolatedRoot> Cuts(const IsolatedRoot& from, std::vector<IsolatedRoot> roots,
                               const IsolatedRoot& to) {
  std::sort(roots.begin(), roots.end(),
            [](const IsolatedRoot& a, const IsolatedRoot& b) { return Compare(a, b) < 0; });
  std::vector<IsolatedRoot> cuts;
  cuts.reserve(roots.size() + 2);
  cuts.push_back(from);
  for (const IsolatedRoot& root : roots) {
    if (Compare(cuts.back(), root) < 0 && Compare(root, to) < 0) cuts.push_back(root);
  }
  cuts.push_back(to);
  return cuts;
}

void StripBuilder::AddSlab(const IsolatedRoot& from, const IsolatedRoot& to,
                           const CurvePairs& between) {
  Slab slab;
  for (const auto& [first, last] : between) {
    std::size_t cell = cells_.size();
    for (std::size_t k = 0; k < last_slab_.size; ++k) {
      const StripCell& before = cells_[last_slab_.cells[k]];
      if (before.first == first && before.last == last) cell = last_slab_.cells[k];
    }
    if (cell < cells_.size()) {
      cells_[cell].to = to;
    } else {
      cells_.push_back({from, to, first, last});
    }
    slab.cells[slab.size++] = cell;
  }
  last_slab_ = slab;
}

}  // namespace farhorizon
