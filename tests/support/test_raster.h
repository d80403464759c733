#pragma once

#include <array>
#include <complex>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace farhorizon {

/// A GeoTIFF as a test wants it; the defaults are a sound DEM of 3 x 2 posts.
struct TestRaster {
  int columns = 3;
  int rows = 2;
  int bands = 1;
  std::string type = "Int16";  ///< GDAL's name of the type
  std::vector<double> values = {1, 2, 3, 4, 5, 6};
  std::vector<std::vector<double>> band_values = {};  ///< where the bands differ
  int alpha_band = 0;                                 ///< its number; 0 for none
  std::optional<std::array<double, 6>> geotransform =
      std::array<double, 6>{500000, 30, 0, 5100000, 0, -30};
  std::string crs = "EPSG:32610";  ///< "" for none; WKT is fine
  std::optional<double> nodata = {};
  std::optional<double> scale = {};
  std::optional<double> offset = {};
  std::string unit = {};
  bool colour_table = false;
  std::vector<int> mask = {};             ///< as values: 0 hides; empty for no mask
  std::vector<std::string> options = {};  ///< "TILED=YES"
  std::vector<std::pair<std::string, std::string>> metadata = {};
};

/// Writes `raster` with GDAL. Throws std::runtime_error where GDAL will not.
void WriteTiff(const std::filesystem::path& path, const TestRaster& raster);

}  // namespace farhorizon
