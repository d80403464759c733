// Orientations are quadratics in the depth: floating point with a bound on its error decides nearly
// all, integers of 128 bits the rest (core/horizon/README.md, section 7, has their sizes).
#include "core/horizon/kinetic/hulls/moving_point.h"

#include <array>
#include <cmath>

namespace farhorizon::kinetic {

namespace {

// x_a y_b - x_b y_a.
Quadratic Minor(const MovingPoint& a, const MovingPoint& b) {
  return {Int128{a.x} * b.y - Int128{a.y} * b.x,
          Int128{a.x} * b.vy + Int128{a.vx} * b.y - Int128{a.y} * b.vx - Int128{a.vy} * b.x,
          Int128{a.vx} * b.vy - Int128{a.vy} * b.vx};
}

// Homogeneous coordinates in floating point, and for each sum the sizes of its terms added up.
struct Nearly {
  double x;
  double y;
  double d;
  double size_x;
  double size_y;
};

Nearly NearlyAt(const MovingPoint& p, double s) {
  const auto x = static_cast<double>(p.x);
  const auto y = static_cast<double>(p.y);
  const double dx = static_cast<double>(p.vx) * s;
  const double dy = static_cast<double>(p.vy) * s;
  return {x + dx, y + dy, static_cast<double>(p.d), std::fabs(x) + std::fabs(dx),
          std::fabs(y) + std::fabs(dy)};
}

// The sign if floating point is sure of it, else 0.
int FilteredOrientation(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c,
                        const SweepDepth& now) {
  const double s = now.lo;
  const double off = now.hi - now.lo;
  if (!(off <= s * 0x1p-40)) return 0;  // any bound is sound: the error below would be too large
  const Nearly p = NearlyAt(a, s);
  const Nearly q = NearlyAt(b, s);
  const Nearly r = NearlyAt(c, s);
  const double value =
      p.d * (q.x * r.y - q.y * r.x) + q.d * (r.x * p.y - r.y * p.x) + r.d * (p.x * q.y - p.y * q.x);
  const double size = p.d * (q.size_x * r.size_y + q.size_y * r.size_x) +
                      q.d * (r.size_x * p.size_y + r.size_y * p.size_x) +
                      r.d * (p.size_x * q.size_y + p.size_y * q.size_x);
  // Each term: two coordinates, off by 2^-51 each from rounding and by off / s from the depth, two
  // products and three sums; relative to its size.
  const double error = size * (0x1p-48 + (s > 0 ? 4 * off / s : 0));
  if (value > error) return 1;
  return value < -error ? -1 : 0;
}

// Whether floating point is sure that sign times the orientation is positive from now to end. A
// quadratic is on an interval at least the least of its three Bernstein coefficients: its values at
// both ends, and its polar form at the two.
bool SurelyHolds(const PointTriple& points, int sign, const SweepDepth& now, std::int64_t end) {
  const auto last = static_cast<double>(end);
  const std::array p{NearlyAt(points.a, now.lo), NearlyAt(points.a, last)};
  const std::array q{NearlyAt(points.b, now.lo), NearlyAt(points.b, last)};
  const std::array r{NearlyAt(points.c, now.lo), NearlyAt(points.c, last)};
  const auto holds = [&](std::size_t i, std::size_t k) {
    const auto minor = [i, k](const std::array<Nearly, 2>& u, const std::array<Nearly, 2>& v) {
      return u[i].x * v[k].y - u[i].y * v[k].x + u[k].x * v[i].y - u[k].y * v[i].x;
    };
    const auto size = [i, k](const std::array<Nearly, 2>& u, const std::array<Nearly, 2>& v) {
      return u[i].size_x * v[k].size_y + u[i].size_y * v[k].size_x + u[k].size_x * v[i].size_y +
             u[k].size_y * v[i].size_x;
    };
    const double value = p[0].d * minor(q, r) + q[0].d * minor(r, p) + r[0].d * minor(p, q);
    // Each term: two coordinates, off by 2^-51 each, three products and five sums.
    return sign * value >
           (p[0].d * size(q, r) + q[0].d * size(r, p) + r[0].d * size(p, q)) * 0x1p-48;
  };
  return holds(0, 1) && holds(0, 0) && holds(1, 1);
}

}  // namespace

MovingPoint MovingPoint::Sliding(Point3i high, Point3i low, std::int64_t summit) {
  const std::int64_t d = std::int64_t{high.z} - low.z;
  const std::int64_t above = summit - high.z;
  const std::int64_t wx = std::int64_t{low.x} - high.x;
  const std::int64_t wy = std::int64_t{low.y} - high.y;
  return {high.x * d - wx * above, wx, high.y * d - wy * above, wy, d};
}

Quadratic Orientation(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c) {
  const Quadratic bc = Minor(b, c);
  const Quadratic ca = Minor(c, a);
  const Quadratic ab = Minor(a, b);
  return {a.d * bc.c0 + b.d * ca.c0 + c.d * ab.c0, a.d * bc.c1 + b.d * ca.c1 + c.d * ab.c1,
          a.d * bc.c2 + b.d * ca.c2 + c.d * ab.c2};
}

int OrientAfter(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c,
                const SweepDepth& now) {
  const int sign = FilteredOrientation(a, b, c, now);
  return sign != 0 ? sign : SignAfter(Orientation(a, b, c), now);
}

int OrientAt(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c, std::int64_t s) {
  const int sign = FilteredOrientation(a, b, c, SweepDepth::At(s));
  if (sign != 0) return sign;
  const Quadratic q = Orientation(a, b, c);
  return SignOf((q.c2 * s + q.c1) * s + q.c0);
}

std::optional<SweepDepth> TurnFailureAfter(const PointTriple& points, int sign,
                                           const SweepDepth& now, std::int64_t end) {
  if (SurelyHolds(points, sign, now, end)) return std::nullopt;
  Quadratic q = Orientation(points.a, points.b, points.c);
  if (sign < 0) q = {-q.c0, -q.c1, -q.c2};
  return FailureAfter(q, now, end);
}

namespace {

// From exact coordinates: of two points that meet at a whole depth, the direction just after is
// that of their speeds.
Aim AimAfter(const MovingPoint& from, const MovingPoint& to, std::int64_t s) {
  const Int128 vx = Int128{to.vx} * from.d - Int128{from.vx} * to.d;
  const Int128 vy = Int128{to.vy} * from.d - Int128{from.vy} * to.d;
  const Int128 dx = Int128{to.x} * from.d - Int128{from.x} * to.d + vx * s;
  const Int128 dy = Int128{to.y} * from.d - Int128{from.y} * to.d + vy * s;
  const bool meet = dx == 0 && dy == 0;
  const auto x = static_cast<double>(meet ? vx : dx);
  const auto y = static_cast<double>(meet ? vy : dy);
  const double norm = std::fabs(x) + std::fabs(y);
  if (norm == 0) return {0, 0, 1};
  return {x / norm, y / norm, 0x1p-50};
}

}  // namespace

Aim AimAt(const MovingPoint& from, const MovingPoint& to, const SweepDepth& now) {
  const double s = now.lo;
  const double off = now.hi - now.lo;
  const Nearly p = NearlyAt(from, s);
  const Nearly q = NearlyAt(to, s);
  const double x = q.x * p.d - p.x * q.d;
  const double y = q.y * p.d - p.y * q.d;
  const double size = (q.size_x + q.size_y) * p.d + (p.size_x + p.size_y) * q.d;
  const double norm = std::fabs(x) + std::fabs(y);
  // As in FilteredOrientation, with one product and one sum.
  const double error = size * (0x1p-49 + (s > 0 ? 4 * off / s : 0));
  if (!(off <= s * 0x1p-40) || error * 4 > norm) {
    return now.whole ? AimAfter(from, to, now.s) : Aim{0, 0, 1};
  }
  return {x / norm, y / norm, error / norm * 2 + 0x1p-51};
}

int OrderAfter(const MovingPoint& a, const MovingPoint& b, const SweepDepth& now) {
  const int sign = SignAfter(
      {Int128{a.x} * b.d - Int128{b.x} * a.d, Int128{a.vx} * b.d - Int128{b.vx} * a.d, 0}, now);
  if (sign != 0) return sign;
  return SignAfter(
      {Int128{a.y} * b.d - Int128{b.y} * a.d, Int128{a.vy} * b.d - Int128{b.vy} * a.d, 0}, now);
}

}  // namespace farhorizon::kinetic
