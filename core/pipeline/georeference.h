#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/geo/frame_choice.h"
#include "core/geo/frames.h"
#include "core/geo/globe_transform.h"
#include "core/pipeline/ground_step.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// A DEM's georeference: the way from its posts to the globe and to the local frame, each point
/// through PROJ, and the way of a decoded mesh back to the grid.
///
/// The local frame is about the grid's middle on the ellipsoid, in metres: exactly there and east,
/// north, up where its axes are the tile's own; along other axes its origin is counted from where
/// all tiles of those axes count, in multiples of a power of two of metres that every lattice's
/// step divides.
/// Errors of all methods with points: kUnsupportedData, kind "outside-crs", where one has no image.
class Georeference {
 public:
  /// options: as GlobeTransform::Open has them, `about` aside. Requires: the terrain's DEM outlives
  ///   the result.
  /// Errors: those of GlobeTransform::Open and ToGeodetic.
  static Result<Georeference> Of(const Terrain& terrain, GlobeOptions options,
                                 const FrameChoice& axes = {});

  [[nodiscard]] const TangentFrame& frame() const { return frame_; }
  [[nodiscard]] const FrameChoice& axes() const { return axes_; }
  /// The grid's middle, on the ellipsoid.
  [[nodiscard]] Geodetic middle() const { return middle_; }
  [[nodiscard]] std::string CrsName() const { return transform_.Name(); }
  /// As GlobeTransform has it.
  [[nodiscard]] double FullTurn() const { return transform_.FullTurn(); }
  /// Whether the grid's middle is in the area where the reference system is used.
  [[nodiscard]] bool InAreaOfUse() const { return transform_.InAreaOfUse(middle_); }
  /// What was assumed about the place.
  [[nodiscard]] const Assumptions& assumptions() const { return transform_.assumptions(); }
  /// Distance of neighbouring posts along a row and along a column in the middle of the grid,
  /// metres.
  [[nodiscard]] double column_step_m() const { return column_step_m_; }
  [[nodiscard]] double row_step_m() const { return row_step_m_; }
  /// True where triangles that run counter-clockwise in (column, -row) do so seen from above.
  [[nodiscard]] bool KeepsOrientation() const;

  [[nodiscard]] Result<std::vector<Geodetic>> ToGeodetic(const std::vector<VertexId>& posts) const;
  /// For points that may lie between posts.
  [[nodiscard]] Result<std::vector<Geodetic>> ToGeodetic(
      const std::vector<GridPoint>& points) const;
  [[nodiscard]] Result<std::vector<Geodetic>> ToGeodetic(const std::vector<Enu>& points) const;
  [[nodiscard]] Result<std::vector<Enu>> ToEnu(const std::vector<Geodetic>& points) const;
  [[nodiscard]] Result<std::vector<Enu>> ToEnu(const std::vector<VertexId>& posts) const;
  [[nodiscard]] Result<std::vector<GridPoint>> ToGrid(const std::vector<Enu>& points) const;
  /// The ground step at each of `points`, given as [column, row]; they may lie between posts.
  [[nodiscard]] Result<std::vector<GroundStep>> StepsAt(
      const std::vector<std::array<double, 2>>& points) const;

 private:
  Georeference(const Dem& dem, GlobeTransform transform, TangentFrame frame);
  Status TurnTo(const FrameChoice& axes);

  const Dem* dem_;
  GlobeTransform transform_;
  TangentFrame frame_;
  FrameChoice axes_;
  Geodetic middle_;
  double column_step_m_ = 0;
  double row_step_m_ = 0;
};

}  // namespace farhorizon
