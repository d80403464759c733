#pragma once

#include "core/geometry/point.h"

namespace farhorizon {

/// A straight piece of ground in exact coordinates: columns, rows, heights in quanta.
struct Segment {
  Point3i a;
  Point3i b;
};

/// `segment`, `steps` lower.
inline Segment Lowered(Segment segment, std::int32_t steps) {
  segment.a.z -= steps;
  segment.b.z -= steps;
  return segment;
}

}  // namespace farhorizon
