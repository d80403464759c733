#pragma once

#include <cstdint>
#include <string_view>

namespace farhorizon {

/// Whether an upload can be a raster of a format that is read: TIFF and BigTIFF, DTED, Arc/Info
/// ASCII Grid, USGS DEM, SRTM HGT. ENVI cannot be sent, since its header is a second file.
/// beginning: the first 4096 bytes, or all if there are fewer; bytes: the size of the whole.
bool LooksLikeRaster(std::string_view beginning, std::int64_t bytes, std::string_view filename);

}  // namespace farhorizon
