#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// A plan line through (x, y) along (dx, dy): all rational with small numbers, so that which edges
/// it crosses is decided exactly.
struct RationalLine {
  std::int64_t x2;  ///< twice x
  std::int64_t y2;  ///< twice y
  std::int64_t dx;
  std::int64_t dy;
};

inline RationalLine RandomLine(const Dem& dem, std::mt19937& random) {
  const auto below = [&random](std::int64_t n) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint32_t>(n));
  };
  RationalLine line{};
  line.x2 = below(2 * dem.columns);
  line.y2 = below(2 * dem.rows);
  do {
    line.dx = below(41) - 20;
    line.dy = below(41) - 20;
  } while (line.dx == 0 && line.dy == 0);
  return line;
}

/// The definition: the greatest height of the triangles' sides over `line`; minus infinity where it
/// misses them.
inline double HeightOverLine(const Terrain& terrain, const std::vector<Triangle>& mesh,
                             const RationalLine& line) {
  double greatest = -std::numeric_limits<double>::infinity();
  const auto side_of = [&line](Point3i p) {
    return line.dx * (2 * p.y - line.y2) - line.dy * (2 * p.x - line.x2);
  };
  for (const Triangle& t : mesh) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3i a = terrain.Point(t[k]);
      const Point3i b = terrain.Point(t[(k + 1) % 3]);
      const std::int64_t of_a = side_of(a);
      const std::int64_t of_b = side_of(b);
      if (of_a == 0) greatest = std::max(greatest, static_cast<double>(a.z));
      if ((of_a < 0 && of_b > 0) || (of_a > 0 && of_b < 0)) {
        const auto whole = static_cast<double>(of_a - of_b);
        greatest = std::max(
            greatest, a.z + (static_cast<double>(b.z) - a.z) * static_cast<double>(of_a) / whole);
      }
    }
  }
  return greatest;
}

}  // namespace farhorizon
