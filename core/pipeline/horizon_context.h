#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/find_horizon.h"
#include "core/horizon/horizon.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

/// For each edge of the terrain's horizon, in its order, whether it is also on the horizon of the
/// terrain with its apron: whether a line of sight that touches it clears the neighbours' ground.
///
/// A line that clears the terrain with its apron clears the terrain, so that no other edge of the
/// terrain can be. Where the work budget ran out before an edge was decided there, it counts as on
/// that horizon.
/// horizon: of input.terrain(). Errors and cost: those of FindHorizon on input.around().
Result<std::vector<bool>> FindInContext(const TerrainInput& input, const Horizon& horizon,
                                        const HorizonOptions& options, const RunControl& control);

/// A terrain's horizon. in_context: as FindInContext has it; empty where that was not asked.
struct HorizonInContext {
  Horizon horizon;
  std::vector<bool> in_context;
};

/// The horizon of input.terrain(), and its context where `asks_context`. budget: of the former.
/// Errors and cost: those of FindHorizon, and of FindInContext.
Result<HorizonInContext> FindHorizonInContext(const TerrainInput& input, bool asks_context,
                                              const HorizonOptions& options, WorkBudget& budget,
                                              const RunControl& control);

}  // namespace farhorizon
