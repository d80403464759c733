#pragma once

#include <vector>

#include "core/horizon/kinetic/hulls/kinetic_hulls.h"

namespace farhorizon::kinetic {

/// The strict corners of the points' convex hull just after `hulls.now()`, counter-clockwise, by
/// Andrew's chains.
std::vector<PointId> HullOf(const KineticHulls& hulls, std::vector<PointId> points);

/// Takes out of a ring that was convex just before now, some of its points gone since, those at
/// which it does not turn left strictly just after.
void RemoveReflex(const KineticHulls& hulls, std::vector<PointId>& ring);

/// Adds a point to a convex ring, in place of the points that the edges seen from it are between.
/// Returns whether the point was outside.
bool AddOutside(const KineticHulls& hulls, PointId p, std::vector<PointId>& ring);

}  // namespace farhorizon::kinetic
