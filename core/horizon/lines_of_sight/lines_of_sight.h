#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/geometry/plan_motion.h"
#include "core/geometry/vector.h"
#include "core/horizon/horizon.h"
#include "core/horizon/work_budget.h"

namespace farhorizon {

/// Lines of sight of an edge a, b: those through its point at t, with from <= t <= to, 0 at a and 1
/// at b, whose direction is from `first` at t counter-clockwise (from columns to rows) to `last` at
/// t.
///
/// Both are in the half turn from the edge's own direction, a to b, to its opposite, ends included.
/// Each turns one way only as t rises, by less than half a turn. Their numbers are integers, exact;
/// `from` and `to` are within 2^-47 of the exact ends. Near a point in which the edge meets another
/// one, a direction may turn far in so short a way: the directions at the exact ends, with any
/// length above 0, are beside them.
struct LineOfSightCell {
  /// The directions of a curve at the exact `from` and `to`, each within 2^-36.
  using Ends = std::array<PlanVector, 2>;

  double from = 0;
  double to = 1;
  PlanMotion first;
  PlanMotion last;
  Ends first_ends;
  Ends last_ends;
};

/// All lines of sight of one edge, except a set of measure zero, as cells that do not overlap.
using LinesOfSight = std::vector<LineOfSightCell>;

/// For each edge of `horizon` all lines of sight that touch it: over them the edge is at the
/// greatest height of the terrain. Found exactly (visible_region.h), then rounded as
/// LineOfSightCell says. Empty for undecided edges; never empty otherwise. The same for any
/// `threads`.
///
/// Requires: `horizon` is FindHorizon's of `terrain`.
/// Errors: kCancelled when a stop is requested. Cost: a few times FindHorizon's.
Result<std::vector<LinesOfSight>> FindLinesOfSight(const Terrain& terrain, const Horizon& horizon,
                                                   int threads, const RunControl& control);

/// The same within what is left of the budget. Where it is approximate and short, it takes half of
/// that, and what it cannot afford is empty, too. Errors: those of WorkThrough (budgeted_work.h).
Result<std::vector<LinesOfSight>> FindLinesOfSight(const Terrain& terrain, const Horizon& horizon,
                                                   int threads, WorkBudget& budget,
                                                   const RunControl& control);

}  // namespace farhorizon
