#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/geometry/segment.h"
#include "core/horizon/sweep/hull_sweep.h"
#include "core/horizon/work_budget.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// An edge that the hulls of the sweep do not rule out. Its virtual occluders are those of
/// Candidates from `first_virtual_occluder` on.
struct Candidate {
  Edge edge;
  std::size_t first_virtual_occluder = 0;
  std::size_t virtual_occluder_count = 0;
};

struct Candidates {
  std::vector<Candidate> edges;  ///< by rising (a, b); contains every horizon edge
  /// Horizontal segments between two corners of one hull, at or above the edge: every line of sight
  /// across one meets ground at its height or above (core/horizon/README.md, section 3).
  std::vector<Segment> virtual_occluders;

  [[nodiscard]] std::span<const Segment> OccludersOf(const Candidate& candidate) const {
    return std::span(virtual_occluders)
        .subspan(candidate.first_virtual_occluder, candidate.virtual_occluder_count);
  }
};

/// The edges that three culls leave: their faces leave directions free (theorem 7 of
/// core/horizon/README.md), their two ends are not in one hull of ground at or above the edge
/// (theorem 5), and the hulls at the height of their upper end do not occlude all directions
/// (theorem 6; edge_occlusion.h).
///
/// The same for any number of threads. Where the budget is approximate and does not suffice, each
/// edge is compared with fewer hulls, and more stay candidates.
/// Errors: kCancelled; kResourceExhausted, kind work-budget, where it is not approximate.
/// Cost: O(n) and, for each edge that the first two culls leave, the hulls that it takes to occlude
/// all directions, some hundreds at most.
Result<Candidates> FindCandidates(const Terrain& terrain, const HullSweep& sweep, int threads,
                                  WorkBudget& budget, const RunControl& control);

}  // namespace farhorizon
