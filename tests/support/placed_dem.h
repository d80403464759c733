#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/io/mesh_files/file_mesh.h"
#include "core/pipeline/terrain_input.h"
#include "tests/oracles/frames_by_formula.h"
#include "tests/support/mesh_writers.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {

/// A DEM of degrees, 30 x 20 posts, heights in whole metres above the ellipsoid by `height(column,
/// row)`, and its full mesh in any frame.
class PlacedDem {
 public:
  static constexpr int kColumns = 30;
  static constexpr int kRows = 20;
  static constexpr double kWest = 7;  // of the first post
  static constexpr double kNorth = 46;
  static constexpr double kStep = 0.001;

  template <typename Height>
  explicit PlacedDem(Height height, const std::vector<double>& nodata = {}) {
    for (int r = 0; r < kRows; ++r) {
      for (int c = 0; c < kColumns; ++c) heights_.push_back(height(c, r));
    }
    TestRaster raster;
    raster.columns = kColumns;
    raster.rows = kRows;
    raster.values = heights_;
    raster.crs = "EPSG:4326";
    raster.geotransform = {{kWest - kStep / 2, kStep, 0, kNorth + kStep / 2, 0, -kStep}};
    if (!nodata.empty()) raster.nodata = nodata.front();
    WriteTiff(path(), raster);
    options_.vertical_datum = "ellipsoid";
    options_.height_unit = "m";
    Result<std::unique_ptr<TerrainInput>> input = TerrainInput::Open(path(), options_, {});
    if (!input) throw std::runtime_error(input.error().message);
    input_ = *std::move(input);
  }
  /// Hills that no turn or mirror maps to themselves.
  PlacedDem() : PlacedDem(Hills) {}

  static double Hills(int c, int r) {
    return std::round(800 + 90 * std::sin(c / 4.0 + r / 9.0) + 50 * std::cos(r / 3.0) + 4 * c -
                      3 * r);
  }

  [[nodiscard]] std::filesystem::path path() const { return folder_ / "dem.tif"; }
  [[nodiscard]] const TempDir& folder() const { return folder_; }
  [[nodiscard]] const TerrainInput& input() const { return *input_; }
  [[nodiscard]] const BuildOptions& options() const { return options_; }
  [[nodiscard]] double Height(std::uint32_t c, std::uint32_t r) const {
    return heights_.at(r * kColumns + c);
  }

  /// Two triangles a cell at posts (x, y, height), y the row.
  [[nodiscard]] PlainMesh InPosts() const {
    return GridMeshOf(kColumns, kRows, [&](auto c, auto r) { return Height(c, r); });
  }
  /// With each point (column, row, height) put where `place` says.
  template <typename Place>
  [[nodiscard]] PlainMesh In(Place place) const {
    PlainMesh mesh = InPosts();
    for (auto& p : mesh.points) p = place(p[0], p[1], p[2]);
    return mesh;
  }
  [[nodiscard]] PlainMesh InEcef() const {
    return In([](double c, double r, double h) -> FilePoint {
      const Ecef p = by_formula::ToEcef({kWest + c * kStep, kNorth - r * kStep, h});
      return {p.x, p.y, p.z};
    });
  }
  /// East, north and up about the grid's middle on the ellipsoid.
  [[nodiscard]] PlainMesh InTileFrame() const {
    const Geodetic middle = {kWest + (kColumns - 1) / 2.0 * kStep,
                             kNorth - (kRows - 1) / 2.0 * kStep, 0};
    PlainMesh mesh = InEcef();
    for (auto& p : mesh.points) {
      const Enu enu = by_formula::ToEnu(middle, {p[0], p[1], p[2]});
      p = {enu.east, enu.north, enu.up};
    }
    return mesh;
  }

 private:
  TempDir folder_;
  BuildOptions options_;
  std::vector<double> heights_;
  std::unique_ptr<TerrainInput> input_;
};

/// As a reader would give it.
inline FileMesh AsFile(const PlainMesh& mesh, FileFrame frame = FileFrame::kUnstated) {
  return {mesh.points, mesh.triangles, frame, 0};
}

/// The same with y up.
inline PlainMesh YUp(PlainMesh mesh) {
  for (auto& p : mesh.points) p = {p[0], p[2], -p[1]};
  return mesh;
}

}  // namespace farhorizon
