#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/horizon/kinetic/hulls/kinetic_hulls.h"

namespace farhorizon::kinetic {

/// Three points of a convex ring whose triangle contains the point just after now, on its border or
/// inside; nullopt where the ring does not contain it. Cost: O(log h) for h points of the ring.
std::optional<std::array<PointId, 3>> TriangleAround(const KineticHulls& hulls,
                                                     std::span<const PointId> ring,
                                                     const MovingPoint& p);

/// Whether the standing point is inside the hull at depth s, as it is reached; false where that is
/// not sure, as on its border. Requires: no event between now and s, and the corners are not stale.
/// Cost: O(log h).
bool SurelyInsideAt(const KineticHulls& hulls, ClusterId c, std::int64_t x, std::int64_t y,
                    std::int64_t s);

/// Whether the two hulls have a point in common just after now. Exact.
bool HullsIntersect(const KineticHulls& hulls, ClusterId a, ClusterId b);

}  // namespace farhorizon::kinetic
