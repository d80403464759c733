#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/geo/crs.h"
#include "core/geo/frames.h"
#include "core/io/tileset.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// What a step of one column and of one row is on the ground, in the directions of true east and north at
/// one place; metres, along the ellipsoid.
struct GroundStep {
  double column_east_m = 0;
  double column_north_m = 0;
  double row_east_m = 0;
  double row_north_m = 0;
};

/// Where a DEM stands on the globe: the way of its posts to the local frame, each through PROJ, and the
/// way of a decoded mesh back to the grid.
class Georeference {
 public:
  /// Errors: those of GlobeTransform::Open and ToGeodetic.
  static Result<Georeference> Of(const Terrain& terrain, const std::string& vertical_datum);

  [[nodiscard]] const TangentFrame& frame() const { return frame_; }
  [[nodiscard]] std::string CrsName() const { return transform_.Name(); }
  /// Distance of neighbouring posts in the middle of the grid along a row and along a column, metres.
  [[nodiscard]] double column_step_m() const { return column_step_m_; }
  [[nodiscard]] double row_step_m() const { return row_step_m_; }
  /// Whether triangles that run counter-clockwise in (column, -row) do so seen from above.
  [[nodiscard]] bool KeepsOrientation() const;

  [[nodiscard]] Result<std::vector<Geodetic>> ToGeodetic(const std::vector<VertexId>& posts) const;
  /// Of points that may lie between posts.
  [[nodiscard]] Result<std::vector<Geodetic>> ToGeodetic(
      const std::vector<GridPoint>& points) const;
  [[nodiscard]] Result<std::vector<Enu>> ToEnu(const std::vector<Geodetic>& points) const;
  [[nodiscard]] Result<std::vector<Enu>> ToEnu(const std::vector<VertexId>& posts) const;
  [[nodiscard]] Result<std::vector<GridPoint>> ToGrid(const std::vector<Enu>& points) const;
  /// At points given as [column, row], which may lie between posts.
  [[nodiscard]] Result<std::vector<GroundStep>> StepsAt(
      const std::vector<std::array<double, 2>>& points) const;

 private:
  Georeference(const Dem& dem, GlobeTransform transform, TangentFrame frame);

  const Dem* dem_;
  GlobeTransform transform_;
  TangentFrame frame_;
  double column_step_m_ = 0;
  double row_step_m_ = 0;
};

}  // namespace farhorizon
