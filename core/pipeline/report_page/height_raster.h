#pragma once

#include <cmath>
#include <vector>

#include "core/pipeline/report_page/picture_frame.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Heights of a surface at the samples of a picture: frame.sample_rows() x frame.sample_columns(),
/// row-major, the topmost first; metres above `base_m`, NaN where there is no surface.
struct HeightRaster {
  std::vector<float> heights_m;
  double base_m = 0;  ///< near the heights, so that the floats resolve millimetres
};

/// The terrain's. Cost: O(samples).
HeightRaster RasterOf(const Terrain& terrain, const PictureFrame& frame);

/// A mesh's. base_m: as in the result. Cost: O(samples + triangles).
HeightRaster RasterOf(const GridMesh& mesh, const PictureFrame& frame, double base_m);

}  // namespace farhorizon
