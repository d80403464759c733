// A DEM as GDAL reads it: its heights in metres, and where its posts are on the Earth.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "grid.h"

class GDALDataset;
class OGRSpatialReference;

namespace farhorizon::peers {

/// One band of heights on a grid that a geotransform places. Posts are the centres of its cells.
///
/// A file that GDAL does not read, or that lies nowhere, ends the program with a message.
class Raster {
 public:
  explicit Raster(const std::string& path);
  ~Raster();

  /// Scale, offset and unit applied; what the mask hides is missing.
  [[nodiscard]] Grid Heights() const;

  /// Metres on the ground from a post in the middle to the next along a row and along a column,
  /// measured between points of the ellipsoid: it holds for every reference system.
  [[nodiscard]] std::array<double, 2> CellMetres() const;

  /// The raster's map, its datum taken for WGS 84, as WKT; empty where WGS 84 is its datum. The
  /// contest is about shapes: what is placed by this comes back to the grid by the map's projection
  /// alone.
  [[nodiscard]] std::string SystemToState() const;

  /// Points of the Earth (EPSG:4978, metres), where SystemToState puts them, over the grid: column,
  /// row and metres above the ellipsoid.
  [[nodiscard]] std::vector<Point> OverGrid(const std::vector<Point>& earth) const;

 private:
  std::unique_ptr<GDALDataset> dataset_;
  std::unique_ptr<OGRSpatialReference> plan_;  // the raster's system on WGS 84, without heights
  bool on_wgs84_ = false;                      // it is the file's own
  std::array<double, 6> map_{};                // of cell corners, as GDAL has it
};

}  // namespace farhorizon::peers
