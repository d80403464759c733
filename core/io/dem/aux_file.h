#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/assumption.h"
#include "core/io/dem/read_dem.h"
#include "core/io/gdal_session.h"

namespace farhorizon {

/// What an auxiliary file says and its dataset has no room for: the nodata values of the band,
/// which add to the file's own; GDAL's geotransform; the reference system, as WKT or a code.
struct AuxTags {
  std::vector<double> nodata = {};
  std::optional<std::array<double, 6>> geotransform = {};
  std::optional<std::string> crs = {};
};

/// Reads FILE.aux.xml beside the file at `path`, in which GDAL and QGIS keep what a format has no
/// place for. Scale, offset and unit of band `number` are put into `dataset` (a GDALDatasetH), the
/// rest is returned. As with GDAL, it wins over the file itself; where they differ, and where
/// something in it is not read (control points, Esri's transformation), that is said. Statistics
/// and histograms mean nothing here.
///
/// The text is parsed, at most 16 MiB of it; no name in it is ever opened. Nothing is written.
AuxTags ReadAuxFile(const std::filesystem::path& path, void* dataset, int number,
                    const DemReadOptions& options, Assumptions& assumptions);

}  // namespace farhorizon
