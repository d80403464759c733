#pragma once

#include <optional>

#include "core/geometry/vector.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The directions, counter-clockwise from `first` to `last`, in which the ground right beside an
/// edge does not rise above the edge (core/horizon/README.md, theorem 7): the same at all its
/// points. Both lie in the half turn from the direction of the edge, lower end to higher, to the
/// opposite direction, ends included; `first` comes before `last`.
struct FaceWedge {
  ShortVector first;
  ShortVector last;
};

/// The wedge between the contours of the two faces beside low -> high. c, d: their third posts, one
/// on each side; a border edge has one of them. nullopt for a horizontal edge, which no wedge
/// describes, and for an edge that is no ridge. Exact.
std::optional<FaceWedge> WedgeOf(const Point3i& low, const Point3i& high,
                                 const std::optional<Point3i>& c, const std::optional<Point3i>& d);

/// The same for an edge of a terrain.
std::optional<FaceWedge> WedgeOf(const Terrain& terrain, Edge edge);

}  // namespace farhorizon
