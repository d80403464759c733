#pragma once

#include <cmath>
#include <cstdint>

#include "core/geometry/point.h"

namespace farhorizon {

/// The least and the greatest of some heights, quanta.
struct HeightRange {
  std::int32_t least = 0;
  std::int32_t greatest = 0;
};

/// Heights in steps finer than quanta: an edge can then be lowered by parts of a quantum and
/// compared exactly with others.
///
/// Not to be confused with the choice of the quantum itself (core/io/dem/values/height_quantum.h).
struct FinerHeights {
  std::int32_t zero = 0;        ///< the height, in quanta, that is 0 steps
  int bits = 0;                 ///< 2^bits steps are a quantum; never negative
  std::int32_t most_steps = 0;  ///< by which any height can be lowered and still be held

  /// With 0 in the middle of the range, for lowering by up to twice the range: the finest steps
  /// with room for that, from 2^-10 quanta to a quantum. All heights of the range, lowered by up to
  /// `most_steps`, stay below 2^30 in size, as occluder sets need
  /// (core/horizon/visibility/occluder_set.h).
  static FinerHeights Centred(const HeightRange& range);

  /// With 0 at the range's least height, for lowering by up to the range: steps of at most
  /// `tolerance` quanta, or, where they have no room, of 2^-30 of the range at most, and of a
  /// quantum at most in any case. All heights of the range, lowered by up to `most_steps`, stay
  /// below 2^31 in size.
  static FinerHeights FromLeast(const HeightRange& range, double tolerance);

  /// Exact.
  [[nodiscard]] Point3i Scale(Point3i p) const {
    const std::int64_t height = std::int64_t{p.z} - zero;
    return {p.x, p.y, static_cast<std::int32_t>(height * (std::int64_t{1} << bits))};
  }
  /// The greatest number of steps that is no more than `quanta`, from 0 up to most_steps.
  [[nodiscard]] std::int32_t Steps(double quanta) const;
  [[nodiscard]] double Quanta(double steps) const { return std::ldexp(steps, -bits); }
};

}  // namespace farhorizon
