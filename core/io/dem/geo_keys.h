#pragma once

#include <optional>

#include "core/io/dem/tiff_file.h"

namespace farhorizon {

/// The number that the GeoKey `key` of the first image of `tiff` has in GeoTIFF's directory of keys
/// (OGC 19-008r4, 7.1.2); nullopt where there is no such key or it is no number.
std::optional<int> ReadGeoKey(TiffFile& tiff, int key);

/// EPSG's code of the unit of heights that the file states by itself (VerticalUnitsGeoKey). GDAL
/// passes over it where the file names a vertical system, whatever that counts.
std::optional<int> VerticalUnitsKey(TiffFile& tiff);

}  // namespace farhorizon
