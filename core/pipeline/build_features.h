#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/io/horizon_features.h"
#include "core/pipeline/edge_measures.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

/// The horizon edges as they are published, in the order of `horizon`.
///
/// level_kept: for each edge the coarsest level that has it, -1 for none; empty where no levels
///   were built.
/// Errors: those of MeasureEdges and Georeference::ToGeodetic.
Result<std::vector<HorizonFeature>> BuildFeatures(const TerrainInput& input, const Horizon& horizon,
                                                  const std::vector<int>& level_kept,
                                                  const MeasureOptions& measuring,
                                                  const RunControl& control);

}  // namespace farhorizon
