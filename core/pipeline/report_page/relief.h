#pragma once

#include "core/io/picture.h"
#include "core/pipeline/report_page/height_raster.h"
#include "core/pipeline/report_page/picture_frame.h"

namespace farhorizon {

/// The factor by which heights are drawn larger in a relief, 1, 2 or 5 times a power of ten, so
/// that gentle ground shows its form and steep ground is not black; 1 for level ground.
double ReliefExaggeration(const HeightRaster& raster, const PictureFrame& frame);

/// The surface in relief, lit from the upper left; white where there is none.
GreyPicture ShadedRelief(const HeightRaster& raster, const PictureFrame& frame,
                         double exaggeration);

}  // namespace farhorizon
