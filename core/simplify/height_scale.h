#pragma once

#include <cstdint>

#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Heights as skylines take them: fine enough for a part of a quantum, and still below 2^30.
struct HeightScale {
  std::int32_t middle = 0;      ///< taken off first, quanta
  int shift = 0;                ///< then multiplied by 2^shift
  std::int32_t most_steps = 0;  ///< by which any height can be lowered and still be held

  /// The finest scale that holds every height of `terrain`, lowered by up to the whole relief.
  static HeightScale For(const Terrain& terrain);

  [[nodiscard]] Point3i Scale(Point3i p) const {
    const std::int64_t z = (std::int64_t{p.z} - middle) * (std::int64_t{1} << shift);
    return {p.x, p.y, static_cast<std::int32_t>(z)};
  }
  /// The greatest number of steps of the scale that is no more than `quanta`, up to most_steps.
  [[nodiscard]] std::int32_t Steps(double quanta) const;
  [[nodiscard]] double Quanta(std::int32_t steps) const {
    return static_cast<double>(steps) / static_cast<double>(std::int64_t{1} << shift);
  }
};

/// `segment` lowered by `steps`.
inline Segment Lowered(Segment segment, std::int32_t steps) {
  segment.a.z -= steps;
  segment.b.z -= steps;
  return segment;
}

}  // namespace farhorizon
