#pragma once

#include <filesystem>
#include <vector>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/io/gdal_session.h"
#include "core/io/raster/driver_open.h"
#include "core/io/text_grid/text_grid.h"

namespace farhorizon {

/// A raster, and what was decided to open it.
struct OpenedRaster {
  std::vector<float> unread = {};  ///< behind the cells of `dataset` that were left unread
  RasterPtr dataset = nullptr;
  Assumptions assumptions = {};
};

/// Opens the raster at `path` in the way that its first bytes, or its name, call for: GeoTIFF,
/// DTED, USGS DEM and SRTM HGT by GDAL's driver; Erdas Imagine, Surfer's binary grids and zipped
/// HGT by the driver in a SealedFolder; ENVI and Esri's rasters (.bil, .bip, .bsq, .flt) there,
/// too, with the .hdr beside, and Esri's .prj; text grids (Arc/Info, GRASS, Surfer, lists of
/// points) in memory, within `limits`, and the .prj beside an Arc/Info grid.
///
/// No other file is opened: names inside a file are never followed.
/// Errors: kNotFound; kInvalidArgument "virtual-path"; kUnsupportedData "not-a-raster", which names
///   what the file is and what makes it readable, "truncated"; kResourceExhausted
///   "raster-too-large"; kIo.
Result<OpenedRaster> OpenRaster(const std::filesystem::path& path, const GridLimits& limits,
                                GdalSession& session);

}  // namespace farhorizon
