#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/horizon/visibility/occluder_set.h"
#include "tests/oracles/quadratic_root.h"

namespace farhorizon {

/// Whether the line through the point at t of `segment`, in the direction (dx, dy), meets no
/// obstacle above that point: the definition of a line of sight. Exact.
bool IsLineOfSight(const Segment& segment, const oracle::DyadicNumber& t,
                   const std::array<oracle::Wide, 2>& direction,
                   const std::vector<Segment>& obstacles);

/// A direction in every range of directions between those in which something can change at t:
/// towards ends of obstacles and towards where they have the height of the point. Not along the
/// segment.
std::vector<std::array<oracle::Wide, 2>> DirectionsAt(const Segment& segment,
                                                      const oracle::DyadicNumber& t,
                                                      const std::vector<Segment>& obstacles);

/// A t in every range of the segment between those points at which something can change in a
/// direction: where a line passes an end of an obstacle, or where an obstacle has the height of the
/// segment over it. Requires: (dx, dy) is not along the segment.
std::vector<oracle::DyadicNumber> PointsAlong(const Segment& segment, std::int64_t dx,
                                              std::int64_t dy,
                                              const std::vector<Segment>& obstacles);

}  // namespace farhorizon
