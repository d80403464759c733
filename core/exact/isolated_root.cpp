#include "core/exact/isolated_root.h"

#include <algorithm>
#include <cmath>

#include "core/base/result.h"

namespace farhorizon {
namespace {

// The root in plain floating point; wrong by much only where two roots nearly coincide.
double Estimate(const QuadraticRoot& root) {
  const auto c0 = static_cast<double>(root.q.c0);
  const auto c1 = static_cast<double>(root.q.c1);
  const auto c2 = static_cast<double>(root.q.c2);
  if (root.q.c2 == 0) return -c0 / c1;
  const double width = std::sqrt(std::max(c1 * c1 - 4 * c2 * c0, 0.0));
  // The sum without cancellation is twice c2 times one root; their product is c0 / c2.
  const double sum = -(c1 + std::copysign(width, c1)) / 2;
  const bool sum_is_upper = (sum > -c1 / 2) == (c2 > 0);
  if (width == 0 || sum_is_upper == root.upper) return sum / c2;
  return sum == 0 ? 0 : c0 / sum;
}

Dyadic Grid(std::int64_t n, int bits) { return {Int128{n}, bits}; }

// The n for which the root lies in [n, n + 1] / 2^bits.
std::int64_t CellOf(const QuadraticRoot& root, double estimate, int bits) {
  const std::int64_t end = std::int64_t{1} << bits;
  const double scaled = std::ldexp(estimate, bits);
  if (scaled > 0 && scaled < static_cast<double>(end)) {
    const auto near = static_cast<std::int64_t>(scaled);
    const int side = Compare(root, Grid(near, bits));
    if (side == 0) return std::min(near, end - 1);
    const std::int64_t n = side > 0 ? near : near - 1;
    if (n >= 0 && n < end && Compare(root, Grid(side > 0 ? n + 1 : n, bits)) * side <= 0) return n;
  }
  std::int64_t low = 0;
  std::int64_t high = end;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (Compare(root, Grid(middle, bits)) >= 0 ? low : high) = middle;
  }
  return low;
}

IsolatedRoot Place(const QuadraticRoot& root) {
  const std::int64_t n = CellOf(root, Estimate(root), kBracketBits);
  return {root, std::ldexp(static_cast<double>(n), -kBracketBits),
          std::ldexp(static_cast<double>(n + 1), -kBracketBits)};
}

}  // namespace

double IsolatedRoot::ToDouble() const {
  if (lo == hi) return lo;
  constexpr int kBits = 48;
  const double estimate = std::clamp(Estimate(root), lo, hi);
  const std::int64_t n = CellOf(root, estimate, kBits);
  const double from = std::ldexp(static_cast<double>(n), -kBits);
  const double to = std::ldexp(static_cast<double>(n + 1), -kBits);
  return std::clamp(estimate, from, to);
}

int Compare(const IsolatedRoot& r, const IsolatedRoot& s) {
  if (r.hi < s.lo) return -1;
  if (r.lo > s.hi) return 1;
  if (r.lo == r.hi && s.lo == s.hi) return 0;
  const Quadratic& p = r.root.q;
  const Quadratic& q = s.root.q;
  if (p.c2 == 0 && q.c2 == 0) {
    // -p0 / p1 against -q0 / q1.
    return CompareProducts(q.c0, p.c1, p.c0, q.c1) * SignOf(p.c1) * SignOf(q.c1);
  }
  if (p.c0 == q.c0 && p.c1 == q.c1 && p.c2 == q.c2) {
    return static_cast<int>(r.root.upper) - static_cast<int>(s.root.upper);
  }
  return Compare(r.root, s.root);
}

std::vector<IsolatedRoot> SignChanges(const Quadratic& q) {
  const int at0 = SignOf(q.c0);
  const int at1 = SignOf(q.c0 + q.c1 + q.c2);
  const int opening = SignOf(q.c2);
  if (opening == 0) {
    if (at0 * at1 < 0) return {Place({q, false})};
    return {};
  }
  if (at0 == 0 && at1 == 0) return {};
  if (at0 == 0) {
    // The other root is -c1 / c2.
    if (SignOf(q.c1) * opening < 0 && (opening > 0 ? -q.c1 < q.c2 : -q.c1 > q.c2)) {
      return {Place({q, true})};
    }
    return {};
  }
  if (at1 == 0) {
    // The other root is c0 / c2.
    if (at0 == opening && (opening > 0 ? q.c0 < q.c2 : q.c0 > q.c2)) return {Place({q, false})};
    return {};
  }
  if (at0 != at1) return {Place({q, at0 != opening})};
  // None or two: the vertex of the parabola lies between, on the other side of the axis.
  const Int128 slope1 = q.c1 + 2 * q.c2;
  if (at0 != opening || SignOf(q.c1) != -opening || SignOf(slope1) != opening) return {};
  if (CompareProducts(q.c1, q.c1, 4 * q.c2, q.c0) <= 0) return {};
  return {Place({q, false}), Place({q, true})};
}

SamplePoint PointBetween(const IsolatedRoot& r, const IsolatedRoot& s) {
  if (r.hi < s.lo) {
    double scale = 2;
    for (int bits = 1; bits <= kBracketBits + 1; ++bits, scale *= 2) {
      const double n = std::floor(r.hi * scale) + 1;
      if (n < s.lo * scale) return {{static_cast<std::int64_t>(n), bits}, std::nullopt};
    }
  }
  const std::optional<WideDyadic> t = Between(r.root, s.root);
  Check(t.has_value(), "there is room between two different numbers");
  if (t->k <= kMaxDyadicBits) return {Narrowed(*t), std::nullopt};
  return {{}, t};
}

}  // namespace farhorizon
