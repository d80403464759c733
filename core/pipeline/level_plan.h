#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "core/pipeline/build_options.h"
#include "core/pipeline/terrain_input.h"
#include "core/simplify/lod_chain.h"

namespace farhorizon {

/// What the levels of a build are asked for.
///
/// lods: of the simplifier. max_error_m: the vertical error that the encoded level 0 may have at a
/// post; 0 where levels are asked for by their triangles.
struct LevelPlan {
  LodPlan lods;
  double max_error_m = 0;

  /// The step that level `level` would have its positions on, metres: see LatticeStep.
  double finest_step_m = 0;
};

/// The plan for a DEM.
///
/// Where options.max_error_m is not set, it is the lesser of an eighth of the cell and a 64th of
/// the relief, but no less than the quantum of the heights, and no less than twice what rounding
/// positions to 16 bits can do to heights. What rounding can do is kept back from the simplifier,
/// up to half of the error.
/// Errors: kInvalidArgument, kind "max-error-too-small", where positions in 16 bits alone would use
///   up the error asked for, with the least that is possible; those of Georeference::ToEnu.
/// Cost: O(posts); a row of posts at a time in memory.
Result<LevelPlan> PlanLevels(const TerrainInput& input, const BuildOptions& options);

/// The step that the positions of level `level` are rounded to where 16 bits reach over them.
inline double LatticeStep(const LevelPlan& plan, int level) {
  return plan.finest_step_m * static_cast<double>(std::int64_t{1} << level);
}

}  // namespace farhorizon
