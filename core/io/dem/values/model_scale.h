#pragma once

#include "core/base/assumption.h"
#include "core/io/dem/tiff/tiff_file.h"

namespace farhorizon {

/// Gives `band` (a GDALRasterBandH) the scale and offset of heights that the third numbers of
/// GeoTIFF's ModelPixelScale and ModelTiepoint state (OGC 19-008r4, B.2 and B.3), and says so. GDAL
/// applies them where the file names a vertical reference system, and otherwise not. A scale of 0
/// states nothing; a scale that the band has of its own wins.
void ApplyModelScale(void* band, TiffFile& tiff, Assumptions& assumptions);

}  // namespace farhorizon
