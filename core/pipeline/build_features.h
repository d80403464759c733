#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/io/horizon_features.h"
#include "core/pipeline/edge_measures.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

/// What else is said of each horizon edge; empty where it is not known.
///
/// level_kept: the coarsest level that has it, -1 for none. in_context: as FindInContext has it.
struct EdgeFacts {
  std::vector<int> level_kept = {};
  std::vector<bool> in_context = {};
};

/// The horizon edges as they are published, in the order of `horizon`.
///
/// Errors: those of MeasureEdges and Georeference::ToGeodetic.
Result<std::vector<HorizonFeature>> BuildFeatures(const TerrainInput& input, const Horizon& horizon,
                                                  const EdgeFacts& facts,
                                                  const MeasureOptions& measuring,
                                                  const RunControl& control);

}  // namespace farhorizon
