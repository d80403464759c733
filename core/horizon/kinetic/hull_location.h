#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/horizon/kinetic/kinetic_hulls.h"

namespace farhorizon::kinetic {

/// Three corners of the cluster whose triangle contains the point just after now, on its border or
/// inside; nullopt where the hull does not contain it. Cost: O(log h), h corners.
std::optional<std::array<PointId, 3>> TriangleAround(const KineticHulls& hulls, ClusterId c,
                                                     const MovingPoint& p);

/// The cluster whose hull, just now (not just after), contains the standing point, inside or on its
/// border; -1 if none does.
/// Requires: now is a whole depth, and nothing was changed at it. Cost: all corners.
ClusterId ClusterContaining(const KineticHulls& hulls, std::int64_t x, std::int64_t y);

/// Whether the two hulls have a point in common just after now. Exact.
bool HullsIntersect(const KineticHulls& hulls, ClusterId a, ClusterId b);
/// The same at depth s, as it is reached. Exact. Requires: no event between now and s.
bool HullsIntersectAt(const KineticHulls& hulls, ClusterId a, ClusterId b, std::int64_t s);

}  // namespace farhorizon::kinetic
