#pragma once

#include "core/geometry/point.h"

namespace farhorizon {

/// A straight piece of ground in exact coordinates: columns, rows, heights in quanta.
struct Segment {
  Point3i a;
  Point3i b;
};

}  // namespace farhorizon
