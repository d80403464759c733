#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/io/draco_mesh.h"
#include "core/pipeline/build.h"
#include "core/pipeline/terrain_input.h"
#include "core/simplify/lod_chain.h"

namespace farhorizon {

/// What a level may be off by, as asked, and how it is divided between simplifying and quantising.
struct LevelPlan {
  double max_error_m = 0;
  double silhouette_error_m = 0;
  LevelBudget budget;
  QuantizationLattice lattice;
};

/// A plan for each level: level 0 as asked, each further one twice the vertical error of the one before
/// and an eighth of that as silhouette error. The lattice's step is a 16th of the silhouette error where 16
/// bits reach over the terrain, and what it can do to heights is kept back from the simplifier.
/// Errors: kInvalidArgument "max-error-too-small" where the lattice alone would use up the error asked
///   for, naming the least possible.
Result<std::vector<LevelPlan>> PlanLevels(const TerrainInput& source, const BuildOptions& options);

}  // namespace farhorizon
