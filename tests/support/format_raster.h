#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/test_raster.h"

namespace farhorizon {

/// Writes `raster` with the driver of GDAL's that has this name, without files of GDAL's own beside
/// it. Throws std::runtime_error where GDAL will not.
void WriteWithDriver(const std::filesystem::path& path, const std::string& driver,
                     const TestRaster& raster, const std::vector<std::string>& options = {});

/// A whole Float32 raster of columns x rows with distinct heights, to be read back from any format.
TestRaster DistinctHeights(int columns, int rows);

}  // namespace farhorizon
