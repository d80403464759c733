#pragma once

#include <cstdint>
#include <string_view>

namespace farhorizon {

/// Whether an upload can be a raster of a format that is read, from its first bytes (4096, or all),
/// its size and its name: TIFF and BigTIFF, DTED, Arc/Info ASCII Grid, USGS DEM, SRTM HGT. ENVI is
/// not among them: its header is a second file.
bool LooksLikeRaster(std::string_view beginning, std::int64_t bytes, std::string_view filename);

/// Whether `filename` is one that the SRTM HGT driver knows: "N46E007.hgt", and with more after it.
bool IsHgtName(std::string_view filename);

}  // namespace farhorizon
