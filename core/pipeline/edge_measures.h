#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/lines_of_sight/lines_of_sight.h"
#include "core/horizon/work_budget.h"
#include "core/io/horizon_features.h"
#include "core/pipeline/georeference.h"
#include "core/pipeline/ground_step.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Azimuths, spans, angular share and line measure of an edge with the given lines of sight; its
/// skyline drop is left 0.
/// along: from a to b, [columns, rows]. step: at the edge's middle.
EdgeMeasures MeasuresOf(const LinesOfSight& sights, std::array<double, 2> along,
                        const GroundStep& step);

/// Which measures of edges are found. kFast: all except skyline drops, which take most of the time.
enum class Weights { kNone, kFast, kFull };

/// How the edges of a horizon are measured.
struct MeasureOptions {
  WorkBudget& budget;  ///< of the run that found the horizon: what it left
  int threads = 1;     ///< never changes the answer
  Weights weights = Weights::kFull;
};

/// The measures of each edge of the horizon, in its order. Where the budget is approximate and does
/// not suffice, some edges have measures that were not afforded.
/// Errors: kCancelled; kResourceExhausted, kind work-budget; those of Georeference::StepsAt.
/// Cost: that of FindLinesOfSight and SkylineDrops.
Result<std::vector<EdgeMeasures>> MeasureEdges(const Terrain& terrain, const Horizon& horizon,
                                               const Georeference& georeference,
                                               const MeasureOptions& options,
                                               const RunControl& control);

}  // namespace farhorizon
