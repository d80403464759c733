// Roots with brackets. A bracket is one cell of the grid of multiples of 2^-kBracketBits; it is
// found from the root in floating point, verified by exact comparisons with the cell's two ends,
// and by bisection where the guess was wrong. Brackets that do not touch order their roots without
// further arithmetic. Cost: a few comparisons of quadratic.h a root.
#include "core/exact/isolated_root.h"

#include <algorithm>
#include <cmath>

#include "core/base/result.h"

namespace farhorizon {

namespace {

// n / 2^bits.
Dyadic Grid(std::int64_t n, int bits) { return {Int128{n}, bits}; }

// The n for which the root lies in [n, n + 1] / 2^bits, 0 <= n < 2^bits. Requires: the root is in
// [0, 1].
std::int64_t CellOf(const QuadraticRoot& root, double guess, int bits) {
  const std::int64_t end = std::int64_t{1} << bits;
  const double scaled = std::ldexp(guess, bits);
  if (scaled > 0 && scaled < static_cast<double>(end)) {
    const auto nearest = static_cast<std::int64_t>(scaled);
    const int side = Compare(root, Grid(nearest, bits));
    if (side == 0) return std::min(nearest, end - 1);
    // The root is in the cell above or below `nearest` if the far end of that cell is beyond the
    // root.
    const std::int64_t n = side > 0 ? nearest : nearest - 1;
    const std::int64_t far_end = side > 0 ? n + 1 : n;
    if (n >= 0 && n < end && Compare(root, Grid(far_end, bits)) * side <= 0) return n;
  }
  std::int64_t low = 0;
  std::int64_t high = end;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (Compare(root, Grid(middle, bits)) >= 0 ? low : high) = middle;
  }
  return low;
}

IsolatedRoot Isolate(const QuadraticRoot& root) {
  const std::int64_t n = CellOf(root, ApproximateRoot(root).value, kBracketBits);
  return {root, std::ldexp(static_cast<double>(n), -kBracketBits),
          std::ldexp(static_cast<double>(n + 1), -kBracketBits)};
}

}  // namespace

double IsolatedRoot::ToDouble() const {
  if (lo == hi) return lo;
  // Where two roots nearly coincide the estimate can be far off. Its distance from the root is at
  // most 2^-48 after it has been moved into the cell of that width in which the root lies.
  constexpr int kBits = 48;
  const double estimate = std::clamp(ApproximateRoot(root).value, lo, hi);
  const std::int64_t n = CellOf(root, estimate, kBits);
  const double from = std::ldexp(static_cast<double>(n), -kBits);
  const double to = std::ldexp(static_cast<double>(n + 1), -kBits);
  return std::clamp(estimate, from, to);
}

WideDyadic Refined(const IsolatedRoot& root, int bits) {
  WideDyadic low{Int1280(std::ldexp(root.lo, kBracketBits)), kBracketBits};
  if (root.lo == root.hi) return low;
  while (low.k < bits) {
    const WideDyadic middle{(low.n << 1) + 1, low.k + 1};
    const int side = Compare(root.root, middle);
    if (side == 0) return middle;
    low = side > 0 ? middle : WideDyadic{low.n << 1, low.k + 1};
  }
  return low;
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
  // Roots this close together are one number as a rule.
  if (SurelyEqual(r.root, s.root)) return 0;
  return Compare(r.root, s.root);
}

// By the signs of q at 0 and at 1 and by the way the parabola opens. A root at 0 or 1 itself is not
// strictly between; the other root is then rational and compared with 0 and 1 by its coefficients.
RootPair SignChanges(const Quadratic& q) {
  const int at0 = SignOf(q.c0);
  const int at1 = SignOf(q.c0 + q.c1 + q.c2);
  const int opening = SignOf(q.c2);
  if (opening == 0) {
    if (at0 * at1 < 0) return RootPair(Isolate({q, false}));
    return {};
  }
  if (at0 == 0 && at1 == 0) return {};
  if (at0 == 0) {
    // The other root is -c1 / c2.
    if (SignOf(q.c1) * opening < 0 && (opening > 0 ? -q.c1 < q.c2 : -q.c1 > q.c2)) {
      return RootPair(Isolate({q, true}));
    }
    return {};
  }
  if (at1 == 0) {
    // The other root is c0 / c2.
    if (at0 == opening && (opening > 0 ? q.c0 < q.c2 : q.c0 > q.c2))
      return RootPair(Isolate({q, false}));
    return {};
  }
  if (at0 != at1) return RootPair(Isolate({q, at0 != opening}));
  // None or two. Two, if the vertex of the parabola lies strictly between 0 and 1, which the slopes
  // at both tell, and beyond the axis, which the discriminant tells.
  const Int128 slope1 = q.c1 + 2 * q.c2;
  if (at0 != opening || SignOf(q.c1) != -opening || SignOf(slope1) != opening) return {};
  if (DiscriminantSign(q) <= 0) return {};
  return {Isolate({q, false}), Isolate({q, true})};
}

SamplePoint PointBetween(const IsolatedRoot& r, const IsolatedRoot& s) {
  if (r.hi < s.lo) {
    // With a step of less than half the gap, the second multiple past its start is within it.
    const int bits = std::max(2 - std::ilogb(s.lo - r.hi), 1);
    const double n = std::floor(std::ldexp(r.hi, bits)) + 1;
    return {{static_cast<std::int64_t>(n), bits}, std::nullopt};
  }
  const std::optional<WideDyadic> t = Between(r.root, s.root);
  Check(t.has_value(), "there is room between two different numbers");
  if (t->k <= kMaxDyadicBits) return {Narrowed(*t), std::nullopt};
  return {{}, t};
}

}  // namespace farhorizon
