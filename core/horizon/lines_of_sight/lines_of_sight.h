#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/geometry/plan_motion.h"
#include "core/horizon/horizon.h"

namespace farhorizon {

/// Lines of sight of an edge: through its point at t, from <= t <= to, 0 at a and 1 at b; at each t in
/// the directions of `first` counter-clockwise (from columns to rows) to those of `last`. Both lie in the
/// half turn from the edge's own direction, a to b, to its opposite, ends included.
///
/// `first` and `last` turn one way only, each by less than half a turn; integers, exact, but for
/// `from` and `to`, which are within 2^-47.
struct LineOfSightCell {
  double from = 0;
  double to = 1;
  PlanMotion first;
  PlanMotion last;
};

/// All lines of sight of one edge, but for a set of measure zero: patches that do not overlap.
using LinesOfSight = std::vector<LineOfSightCell>;

/// For each edge of `horizon`, all lines of sight that touch it and nowhere meet higher ground. They are
/// found exactly and then written in doubles (visible_region.h). None for an undecided edge, which nobody
/// could afford to look at; others have some.
///
/// Requires: `horizon` is FindHorizon's of `terrain`.
/// Errors: kCancelled when the watch says stop. The same for any `threads`.
/// Cost: a few times FindHorizon's.
Result<std::vector<LinesOfSight>> FindLinesOfSight(const Terrain& terrain, const Horizon& horizon,
                                                   int threads, const Watch& watch);

}  // namespace farhorizon
