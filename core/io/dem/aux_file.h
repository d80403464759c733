#pragma once

#include <filesystem>
#include <vector>

#include "core/base/assumption.h"
#include "core/io/dem/read_dem.h"
#include "core/io/gdal_session.h"

namespace farhorizon {

/// Reads FILE.aux.xml beside the file at `path`, in which GDAL and QGIS keep what a format has no
/// place for, into `dataset` (a GDALDatasetH), where the rest of the reader finds it: the scale,
/// offset and unit of band `number`, geotransform and reference system. As with GDAL, it wins over
/// the file itself; where they differ, and where something in it is not read (control points,
/// Esri's transformation), that is said. Statistics and histograms mean nothing here.
///
/// The text is parsed, at most 16 MiB of it; no name in it is ever opened. Nothing is written.
/// Returns the nodata values that it names for the band; they add to the file's own.
std::vector<double> ReadAuxFile(const std::filesystem::path& path, void* dataset, int number,
                                const DemReadOptions& options, Assumptions& assumptions);

}  // namespace farhorizon
