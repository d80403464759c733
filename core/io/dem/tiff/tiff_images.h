#pragma once

#include "core/base/assumption.h"
#include "core/io/dem/tiff/tiff_file.h"

namespace farhorizon {

/// Says which image of a TIFF of several was read: GDAL reads the first. Overviews and masks (by
/// NewSubfileType) are no further images; but where the first one is itself a reduced image, that
/// is said.
void SayWhichImage(TiffFile& tiff, Assumptions& assumptions);

}  // namespace farhorizon
