#pragma once

#include <cstdint>
#include <optional>

#include "core/horizon/visibility/occluder_set.h"

namespace farhorizon {

/// The plan line a x + b y = c.
template <typename Int>
struct LineEquation {
  Int a;
  Int b;
  Int c;
};

/// numerator / denominator, denominator > 0.
template <typename Int>
struct Ratio {
  Int numerator;
  Int denominator;

  friend bool operator<(const Ratio& p, const Ratio& q) {
    return p.numerator * q.denominator < q.numerator * p.denominator;
  }
  friend bool operator==(const Ratio& p, const Ratio& q) {
    return p.numerator * q.denominator == q.numerator * p.denominator;
  }
};

/// The greatest height of a segment over a plan line; nullopt where the line misses it. Exact, if
/// Int holds a height times the side of a point (a x + b y - c), twice over.
template <typename Int>
std::optional<Ratio<Int>> HeightOver(const LineEquation<Int>& line, const Segment& segment) {
  const Int side_a = line.a * segment.a.x + line.b * segment.a.y - line.c;
  const Int side_b = line.a * segment.b.x + line.b * segment.b.y - line.c;
  if ((side_a > 0 && side_b > 0) || (side_a < 0 && side_b < 0)) return std::nullopt;
  const Int z_a = segment.a.z;
  const Int z_b = segment.b.z;
  if (side_a == side_b) return Ratio<Int>{z_a > z_b ? z_a : z_b, 1};  // along the line
  // At the share side_a / (side_a - side_b) of the way from a to b.
  const Int numerator = z_b * side_a - z_a * side_b;
  const Int denominator = side_a - side_b;
  if (denominator < 0) return Ratio<Int>{-numerator, -denominator};
  return Ratio<Int>{numerator, denominator};
}

/// The line through the point t = numerator / denominator of the way along `segment`, in the
/// direction (dx, dy).
template <typename Int>
LineEquation<Int> LineThrough(const Segment& segment, const Int& numerator, const Int& denominator,
                              const Int& dx, const Int& dy) {
  const Int x = segment.a.x * denominator + (Int(segment.b.x) - segment.a.x) * numerator;
  const Int y = segment.a.y * denominator + (Int(segment.b.y) - segment.a.y) * numerator;
  return {dy * denominator, -dx * denominator, dy * x - dx * y};
}

}  // namespace farhorizon
