#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

/// How a mesh's heights go with the DEM's over the posts that both have.
///
/// posts: how many. mean_m: of mesh less DEM. median_m, spread_m: the median of that, and the
/// median distance from it. slope: by which the mesh rises where the DEM rises by one (least
/// squares); correlation: 1 where a straight line maps one to the other, 0 where level ground
/// leaves both open.
struct HeightAgreement {
  std::int64_t posts = 0;
  double mean_m = 0;
  double median_m = 0;
  double spread_m = 0;
  double slope = 1;
  double correlation = 0;
};

/// heights: of HeightsOverPosts. Cost: O(posts).
HeightAgreement CompareHeights(const std::vector<double>& heights, const Dem& dem);

/// Whether the heights can be those of the DEM.
/// Errors: kUnsupportedData, kind "mesh-elsewhere", with what was measured and the likely cause,
///   where the mesh is upside down, in another unit, or off by a constant (another vertical datum).
Status CheckHeights(const HeightAgreement& agreement, const TerrainInput& input);

}  // namespace farhorizon
