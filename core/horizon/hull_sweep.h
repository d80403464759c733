#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// An edge that the sweep could not rule out, and what it knows to hide much of it.
/// screens: level segments between corners of one hull, at or above the edge: every line of sight that
/// crosses one meets ground of its height or more.
struct Candidate {
  Edge edge;
  std::size_t first_screen = 0;
  std::size_t screen_count = 0;
};

/// What a plane that descends through the terrain finds out at once.
struct HullSweep {
  std::vector<Candidate> candidates;  ///< by rising (a, b); contains every horizon edge
  std::vector<Segment> screens;
  HullForest hulls;
  HorizonStatistics statistics;
};

/// Sweeps the terrain from its summit down, keeping the merged hulls of the ground at or above the
/// plane, and leaves as candidates the creases that are no valley and whose lower end is outside
/// the hull that their upper end joins.
///
/// Cost: O(n log n) plus, for each vertex that enlarges a hull, the size of the hull and the hulls
/// apart. Errors: kCancelled.
Result<HullSweep> SweepHulls(const Terrain& terrain, const Watch& watch);

}  // namespace farhorizon
