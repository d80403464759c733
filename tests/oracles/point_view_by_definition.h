#pragma once

#include <cstdint>
#include <vector>

#include "core/horizon/visibility/occluder_set.h"
#include "tests/oracles/quadratic_root.h"

namespace farhorizon::oracle {

/// A vector of the plan that moves linearly, in machine integers.
struct MovingVector64 {
  std::int64_t x0 = 0;
  std::int64_t y0 = 0;
  std::int64_t x1 = 0;
  std::int64_t y1 = 0;
  [[nodiscard]] MovingVector Widened() const { return {x0, y0, x1, y1}; }
};

/// A segment seen from p(t) = a + t (b - a) on the segment asked about, t in (0, 1).
///
/// The vectors run from p(t) to its lower end, its higher end and its point at the height of p(t),
/// each times some positive number. `above`: its height over p(t), times a positive number, for a
/// segment whose line in plan is that of ab.
struct Obstacle {
  std::int64_t low_z = 0;
  std::int64_t high_z = 0;
  MovingVector64 to_low;
  MovingVector64 to_high;
  MovingVector64 to_slice;
  bool parallel = false;
  Quadratic above;
};

/// What p(t) looks at: everything that one sample needs.
struct SightProblem {
  std::int64_t z0 = 0;  ///< height of p(t) = z0 + t z1
  std::int64_t z1 = 0;
  Ties ties = Ties::kPass;
  std::vector<Obstacle> obstacles;
  std::int64_t largest = 0;  ///< no coefficient of a vector or a height is larger
};

/// One obstacle's part in hiding p(t): the arc of directions from `Start` to `End`,
/// counter-clockwise.
struct CoverLink {
  std::size_t obstacle = 0;
  bool over = false;     ///< it passes over p(t) itself and hides every direction
  bool slice = false;    ///< its arc begins at its slice point, not at its lower end
  bool swapped = false;  ///< its arc runs from the higher end to the lower
};

/// Directions counter-clockwise from (from_x, from_y) to (to_x, to_y), less than or just 180
/// degrees, ends excluded: lines that no obstacle's arc blocks.
struct FreeGap {
  Wide from_x;
  Wide from_y;
  Wide to_x;
  Wide to_y;
};

/// What one position t tells.
struct LineVerdict {
  enum class Kind {
    kFree,      ///< some open set of lines of sight around p(t) meets no obstacle
    kOccluded,  ///< the closed arcs of `cover`, each overlapping the next in a ring, are the circle
    kCritical,  ///< t is where something changes: it tells nothing about its neighbours
  };
  Kind kind = Kind::kCritical;
  std::vector<CoverLink> cover = {};
  FreeGap gap = {};  ///< where kFree
};

/// Looks around from p(t). Exact.
LineVerdict LookAround(const SightProblem& problem, const DyadicNumber& t);

}  // namespace farhorizon::oracle
