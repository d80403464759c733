#include "core/io/dem/values/model_scale.h"

#include <cmath>
#include <vector>

#include <gdal.h>

#include "core/io/dem/values/number_text.h"

namespace farhorizon {

void ApplyModelScale(void* band, TiffFile& tiff, Assumptions& assumptions) {
  int has_scale = 0;
  int has_offset = 0;
  GDALGetRasterScale(band, &has_scale);
  GDALGetRasterOffset(band, &has_offset);
  const std::vector<double> scales = tiff.Numbers(0, TiffTag::kModelPixelScale, 3);
  if (has_scale != 0 || has_offset != 0 || scales.size() < 3 || scales[2] == 0) return;
  const double scale = scales[2];
  // One tie point: raster (i, j, k) is at model (x, y, z).
  const std::vector<double> tie = tiff.Numbers(0, TiffTag::kModelTiepoint, 7);
  const double offset = tie.size() == 6 ? tie[5] - tie[2] * scale : 0;
  if (!std::isfinite(scale) || !std::isfinite(offset) || (scale == 1 && offset == 0)) return;
  GDALSetRasterScale(band, scale);
  GDALSetRasterOffset(band, offset);
  assumptions.push_back(
      {"model-scale", "heights were taken as " + NumberText(scale) + " times the stored numbers" +
                          (offset != 0 ? " plus " + NumberText(offset) : std::string()) +
                          ", as the file's ModelPixelScale says; if they are heights as stored, "
                          "gdal_translate IN OUT leaves that scale out"});
}

}  // namespace farhorizon
