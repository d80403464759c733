#pragma once

#include <cstddef>

#include "core/base/result.h"
#include "core/pipeline/build_options.h"
#include "core/pipeline/terrain_input.h"
#include "core/simplify/lod_chain.h"

namespace farhorizon {

/// What the levels of a build are asked for.
///
/// lods: of the simplifier. max_error_m: the vertical error that the encoded level 0 may have at a
/// post; 0 where levels are asked for by their triangles. finest_side_m: as FinestSideStep has it.
struct LevelPlan {
  LodPlan lods;
  double max_error_m = 0;
  double finest_side_m = 0;
};

/// The plan for a DEM.
///
/// Where options.max_error_m is not set, it is the lesser of an eighth of the cell and a 64th of
/// the relief, but no less than the quantum of the heights, and no less than twice what rounding
/// positions can do to heights. What rounding can do is kept back from the simplifier,
/// up to half of the error.
/// Errors: kInvalidArgument, kind "max-error-too-small", where rounding positions in
///   kMaxLatticeBits would use up the error asked for, with the least that is possible; those of
///   Georeference::ToEnu.
/// Cost: O(posts); a row of posts at a time in memory.
Result<LevelPlan> PlanLevels(const TerrainInput& input, const BuildOptions& options);

/// Which of the levels by size a level is like: its sides are rounded as that one's. By size it is
/// its own number; by triangles it is the same for tiles of `dem`'s columns and rows that are asked
/// alike.
int CoarsenessOf(const LevelPlan& plan, const Dem& dem, std::size_t level);

}  // namespace farhorizon
