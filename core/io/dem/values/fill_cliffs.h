#pragma once

#include <vector>

#include "core/base/assumption.h"
#include "core/io/dem/values/sample_type.h"
#include "core/io/dem/values/value_scale.h"

namespace farhorizon {

/// Says where posts of one value look like a fill that no tag names, though ground may have that
/// height: cliffs stand all along their rim, as around the zeros that gdalwarp leaves beside a
/// turned raster. The posts are kept as ground; `--nodata` states that they are none.
///
/// Looked at are 0, the least value, the greatest where it is customary for no data, and those in
/// the raster's corners. The steps from a lake or a sea to its shore are as high as other steps of
/// the ground; those to a fill are as high as the ground itself.
/// values: raw, NaN where there is no data, rows of `columns` posts; scale: makes metres of them.
/// Cost: O(posts), three passes.
void SayFillsWithCliffs(const std::vector<double>& values, int columns, const SampleType& samples,
                        const ValueScale& scale, Assumptions& assumptions);

}  // namespace farhorizon
