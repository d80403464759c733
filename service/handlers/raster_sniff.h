#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/result.h"

namespace farhorizon {

/// Whether an upload can be a raster of a format that is read and is one file: TIFF and BigTIFF,
/// DTED, USGS DEM, SRTM HGT and that zipped (by their names), Erdas Imagine, Surfer's grids, and
/// the text grids. Numbers with a header beside (ENVI, Esri) cannot be sent.
///
/// What is let in is read by this program's own readers, or by one driver of GDAL's that sees a
/// folder with this file alone (OpenRaster).
/// beginning: the first 4096 bytes, or all if there are fewer; bytes: the size of the whole.
/// Errors: kUnsupportedData, kinds "not-a-raster", which says what the upload is and what makes it
///   readable, and "truncated" for an HGT tile of another size.
Status CheckUpload(std::string_view beginning, std::int64_t bytes, std::string_view filename);

}  // namespace farhorizon
