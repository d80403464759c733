// All lines of sight of a segment, asked one by one: complete in direction for one point, complete
// along the segment for one direction.
#include "tests/oracles/lines_of_sight_by_definition.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "tests/support/line_equation.h"

namespace farhorizon {
namespace {

using oracle::DyadicNumber;
using oracle::QuadraticNumber;
using oracle::Wide;

using Direction = std::array<Wide, 2>;

Wide Cross(const Direction& a, const Direction& b) { return a[0] * b[1] - a[1] * b[0]; }

template <typename Int>
bool NothingAbove(const Segment& segment, const Int& n, const Int& whole, const Int& dx,
                  const Int& dy, const std::vector<Segment>& obstacles) {
  const LineEquation<Int> line = LineThrough<Int>(segment, n, whole, dx, dy);
  const Ratio<Int> own{segment.a.z * whole + (Int(segment.b.z) - segment.a.z) * n, whole};
  return std::none_of(obstacles.begin(), obstacles.end(), [&](const Segment& f) {
    const std::optional<Ratio<Int>> height = HeightOver<Int>(line, f);
    return height && own < *height;
  });
}

// The side of a point of the line through (0, 0) in the direction.
std::int64_t Offset(Point3i p, std::int64_t dx, std::int64_t dy) { return dx * p.y - dy * p.x; }

}  // namespace

bool IsLineOfSight(const Segment& segment, const DyadicNumber& t, const Direction& direction,
                   const std::vector<Segment>& obstacles) {
  const Wide whole = Wide(1) << static_cast<unsigned>(t.exponent);
  // Coordinates below 2^5, heights below 2^6: sides below 2^(25 + 2 * 14 + 6), products of two and
  // more.
  const Wide small = Wide(1) << 25;
  const bool narrow = t.exponent <= 14 && direction[0] < small && direction[0] > -small &&
                      direction[1] < small && direction[1] > -small &&
                      std::all_of(obstacles.begin(), obstacles.end(), [](const Segment& f) {
                        return std::max({f.a.x, f.a.y, f.b.x, f.b.y}) < 32 &&
                               std::max({f.a.z, f.b.z}) < 64 && std::min({f.a.z, f.b.z}) > -64;
                      });
  if (narrow) {
    const auto as128 = [](const Wide& w) { return static_cast<__int128>(w); };
    return NothingAbove<__int128>(segment, as128(t.numerator), as128(whole), as128(direction[0]),
                                  as128(direction[1]), obstacles);
  }
  return NothingAbove<Wide>(segment, t.numerator, whole, direction[0], direction[1], obstacles);
}

std::vector<Direction> DirectionsAt(const Segment& segment, const DyadicNumber& t,
                                    const std::vector<Segment>& obstacles) {
  const Wide whole = Wide(1) << static_cast<unsigned>(t.exponent);
  const auto at = [&](std::int32_t a, std::int32_t b) -> Wide {
    return a * whole + (Wide(b) - a) * t.numerator;
  };
  const Wide x = at(segment.a.x, segment.b.x);
  const Wide y = at(segment.a.y, segment.b.y);
  const Wide z = at(segment.a.z, segment.b.z);
  const Direction along{segment.b.x - segment.a.x, segment.b.y - segment.a.y};
  std::vector<Direction> critical;
  const auto add = [&](const Direction& v) {
    const Wide side = Cross(along, v);
    if (side != 0) critical.push_back(side > 0 ? v : Direction{-v[0], -v[1]});
  };
  for (const Segment& f : obstacles) {
    for (const Point3i& p : {f.a, f.b}) add({p.x * whole - x, p.y * whole - y});
    const Wide rise = Wide(f.b.z) - f.a.z;
    const Wide over = z - f.a.z * whole;
    if (rise == 0) continue;
    // f.a + (f.b - f.a) * over / (rise * whole), from the point, times |rise| * whole.
    const Wide sign = rise > 0 ? 1 : -1;
    add({sign * ((f.a.x * whole - x) * rise + (Wide(f.b.x) - f.a.x) * over),
         sign * ((f.a.y * whole - y) * rise + (Wide(f.b.y) - f.a.y) * over)});
  }
  std::sort(critical.begin(), critical.end(),
            [](const Direction& a, const Direction& b) { return Cross(a, b) > 0; });
  std::vector<Direction> between;
  Direction last = along;
  critical.push_back({-along[0], -along[1]});
  for (const Direction& next : critical) {
    const bool half_turn = next == critical.back() && between.empty() && last == along;
    if (half_turn) {
      between.push_back({-along[1], along[0]});
    } else if (Cross(last, next) != 0) {
      between.push_back({last[0] + next[0], last[1] + next[1]});
    }
    last = next;
  }
  return between;
}

std::vector<DyadicNumber> PointsAlong(const Segment& segment, std::int64_t dx, std::int64_t dy,
                                      const std::vector<Segment>& obstacles) {
  const std::int64_t start = Offset(segment.a, dx, dy);
  const std::int64_t run = Offset(segment.b, dx, dy) - start;
  const std::int64_t climb = std::int64_t{segment.b.z} - segment.a.z;
  std::vector<QuadraticNumber> critical = {QuadraticNumber::Rational(0, 1),
                                           QuadraticNumber::Rational(1, 1)};
  const auto add = [&critical](Wide numerator, Wide denominator) {
    if (denominator < 0) {
      numerator = -numerator;
      denominator = -denominator;
    }
    if (denominator != 0 && numerator > 0 && numerator < denominator) {
      critical.push_back(QuadraticNumber::Rational(numerator, denominator));
    }
  };
  for (const Segment& f : obstacles) {
    const std::int64_t from = Offset(f.a, dx, dy) - start;
    const std::int64_t to = Offset(f.b, dx, dy) - start;
    add(from, run);
    add(to, run);
    // f.a.z + rise (t run - from) / (to - from) = segment.a.z + climb t.
    const Wide rise = Wide(f.b.z) - f.a.z;
    const Wide width = Wide(to) - from;
    add((Wide(segment.a.z) - f.a.z) * width + rise * from, rise * run - climb * width);
  }
  std::sort(critical.begin(), critical.end());
  std::vector<DyadicNumber> between;
  for (std::size_t i = 0; i + 1 < critical.size(); ++i) {
    if (critical[i] < critical[i + 1]) {
      between.push_back(oracle::SimplestBetween(critical[i], critical[i + 1]));
    }
  }
  return between;
}

}  // namespace farhorizon
