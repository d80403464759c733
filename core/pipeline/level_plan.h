#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/io/quantization_lattice.h"
#include "core/pipeline/build_options.h"
#include "core/pipeline/terrain_input.h"
#include "core/simplify/lod_chain.h"

namespace farhorizon {

/// What one level is asked for, and how its errors are divided between simplifying and quantising.
///
/// max_error_m, silhouette_error_m: the vertical and the silhouette error that the level may have.
/// budget: what is left of both for the simplifier. lattice: of the level's positions.
struct LevelPlan {
  double max_error_m = 0;
  double silhouette_error_m = 0;
  LevelBudget budget;
  QuantizationLattice lattice;
};

/// A plan for each level: level 0 as asked, each further level with twice the vertical error of the
/// one before it and an eighth of that as silhouette error, or the silhouette error asked for where
/// that is more. The lattice's step is a 16th of that eighth where 16 bits reach over the terrain;
/// the most that rounding can do to heights is kept back from the simplifier.
/// Errors: kInvalidArgument, kind "max-error-too-small", where the lattice alone would use up the
///   error asked for, with the least that is possible; those of LatticeFor.
Result<std::vector<LevelPlan>> PlanLevels(const TerrainInput& input, const BuildOptions& options);

}  // namespace farhorizon
