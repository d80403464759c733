#pragma once

#include <cstdint>
#include <vector>

#include "core/pipeline/compare/compare.h"

namespace farhorizon {

/// The tiles of one depth of a tileset, taken together.
///
/// vertical, facet_angle_rms_deg: greatest, and root of the mean over all posts of all tiles, those
/// on a common side counted in each. silhouette_max_m, rim_m: the greatest of the tiles' bounds,
/// which bounds the whole, since the greatest height over a line is the greatest over its parts; of
/// the rms the tiles alone do not tell.
struct LevelSummary {
  int depth = 0;
  std::int64_t tiles = 0;
  std::int64_t triangles = 0;
  std::int64_t vertices = 0;
  ErrorMeasure vertical;
  double silhouette_max_m = 0;
  double rim_m = 0;
  double facet_angle_rms_deg = 0;
  double needle_share = 0;
};

/// Of each depth with several tiles that were measured, the least depth first.
std::vector<LevelSummary> SummarizeLevels(const std::vector<MeshComparison>& meshes);

}  // namespace farhorizon
