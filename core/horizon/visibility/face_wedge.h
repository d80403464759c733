#pragma once

#include <optional>

#include "core/geometry/vector.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The directions, counter-clockwise from `first` to `last`, in which the ground right beside an edge does
/// not rise above it: the same at all its points. Both lie in the half turn from the direction of
/// the edge, lower end to higher, to its opposite, ends included; first comes before last.
struct FaceWedge {
  ShortVector first;
  ShortVector last;
};

/// Between the contours of the two faces beside low -> high, whose third posts are `c` and `d`, one on each
/// side; an edge of the border has one. nullopt for a level edge (none of its faces hides it) and for one
/// that is no ridge. Exact.
std::optional<FaceWedge> WedgeOf(const Point3i& low, const Point3i& high,
                                 const std::optional<Point3i>& c, const std::optional<Point3i>& d);

/// The same for an edge of a terrain.
std::optional<FaceWedge> WedgeOf(const Terrain& terrain, Edge edge);

}  // namespace farhorizon
