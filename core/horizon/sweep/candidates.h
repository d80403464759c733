#pragma once

#include <cstddef>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/sweep/hull_sweep.h"
#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// An edge that the hulls of the sweep do not rule out, and what they hide of it.
/// virtual occluders: level segments between corners of one hull, at or above the edge: every line of sight that
/// crosses one meets ground of its height or more.
struct Candidate {
  Edge edge;
  std::size_t first_virtual_occluder = 0;
  std::size_t virtual_occluder_count = 0;
};

struct Candidates {
  std::vector<Candidate> edges;  ///< by rising (a, b); contains every horizon edge
  std::vector<Segment> virtual_occluders;
};

/// Leaves as candidates the edges between whose faces a line of sight can pass, whose lower end is outside
/// the hull that their upper end joins, and of which the hulls at the level of their upper end do not
/// hide all directions (edge_occlusion.h).
///
/// The sweep's changes are gone through again, a part of them by each thread. Errors: kCancelled. The
/// same for any `threads`.
/// Cost: O(n), and for each edge outside the hulls their number.
Result<Candidates> FindCandidates(const Terrain& terrain, const HullSweep& sweep, int threads,
                                  const Watch& watch);

}  // namespace farhorizon
