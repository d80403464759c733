#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Greatest and root mean square of an error, metres.
struct ErrorMeasure {
  double max_m = 0;
  double rms_m = 0;
};

/// A point of a frame in which the sides of a mesh's triangles are straight, metres: the local
/// frame (east, north, up) of a mesh on the globe, or the map.
using StraightPoint = std::array<double, 3>;

/// Where a DEM's posts are in the frame in which meshes are straight, and where up is there.
///
/// positions: one a post, row by row; of posts without data any. Empty: meshes are straight in the
///   frame of the grid, and vertical errors are differences of heights in it.
/// up, up_at_origin: the vertical at the point p has the direction up_at_origin + up p; `up` is 3 x
///   3, row by row. On an ellipsoid that is the normal, right to 1e-5 for heights up to 20 km; on a
///   map it is constant.
/// column_m, row_m: a step of a column and of a row on the ground, metres: for angles.
struct PostPlaces {
  std::vector<StraightPoint> positions;
  std::array<double, 9> up = {};
  StraightPoint up_at_origin = {0, 0, 1};
  double column_m = 1;
  double row_m = 1;
};

/// Any mesh to be measured: in the frame of the grid, and in the frame in which it is straight.
///
/// Vertices need not be posts nor have their heights; the mesh need not cover the DEM.
/// straight: where grid.points are in the frame of PostPlaces; empty where that has no positions.
struct PlacedMesh {
  GridMesh grid;
  std::vector<StraightPoint> straight;
};

/// What is wrong with a mesh as a surface over the plan. All 0: none of it was found.
struct MeshDefects {
  std::int64_t flipped = 0;        ///< triangles that turn the wrong way, or have no area, in plan
  std::int64_t open_edges = 0;     ///< edges with one triangle, off the terrain's outline
  std::int64_t crowded_edges = 0;  ///< edges with two triangles on one side
  std::int64_t covered_twice = 0;  ///< posts inside several triangles
};

/// How far a mesh is from its DEM.
///
/// H(l) is the greatest height of a surface over the plan line l; the silhouette error on l is
/// |H_dem(l) - H_mesh(l)|, in the frame of the grid, over lines that meet both surfaces.
struct MeshError {
  /// At the posts: the distance, along the vertical of the post, to the mesh in the frame in which
  /// it is straight. A post that the mesh misses by up to half a cell takes the nearest point of
  /// its outline and the plane of the triangle there, the worse of both; others are not covered and
  /// do not count.
  ErrorMeasure vertical;
  /// max_m: a proven upper bound over all lines on which the higher of both skylines is attained
  /// off the outline of its surface. rms_m: over a sample of lines, uniform in the measure of lines
  /// (line_sampling.h).
  ErrorMeasure silhouette;
  /// The same bound over the lines, too, on which the higher skyline is attained on an outline, or
  /// where the other surface does not reach. Lines that graze an outline (kGrazingAngle) are left
  /// out of both: there any displacement of a vertex moves a skyline by any amount. Never below
  /// silhouette.max_m.
  double rim_m = 0;
  /// Greatest errors on the sampled lines: what is certainly attained. Lines with either skyline on
  /// an outline count in sampled_rim_m alone.
  double sampled_max_m = 0;
  double sampled_rim_m = 0;
  /// Root mean square of the angle between the planes of the DEM's triangles and that of the mesh
  /// over them, each of the DEM's triangles that the mesh covers weighted alike, so by area in
  /// plan; degrees, at true proportions (PostPlaces::column_m, row_m): how it looks when lit.
  double facet_angle_rms_deg = 0;
  /// The share of the mesh's triangles that have an angle below 2 degrees in space.
  double needle_share = 0;
  /// The share of the DEM's posts that the mesh covers, or misses by no more than half a cell.
  double covered_share = 0;
  MeshDefects defects;
};

/// Lines within this angle of the grid's rows, columns or diagonals, or of a side of the outline
/// that they cross, are left out of the bounds where their skyline is attained within about a cell
/// of an outline; radians of the grid. A level's outline is off the DEM's by up to a hundredth of a
/// cell: at this angle that shifts by ten cells where a line enters. Of lines drawn uniformly about
/// one in 10^6 crosses a side at less.
inline constexpr double kGrazingAngle = 1.0 / 1024;

/// Measures meshes against one DEM: what belongs to the DEM alone is computed once.
class MeshMeasurer {
 public:
  /// Requires: terrain and horizon outlive it.
  MeshMeasurer(const Terrain& terrain, const Horizon& horizon, PostPlaces places);
  MeshMeasurer(MeshMeasurer&&) noexcept;
  MeshMeasurer& operator=(MeshMeasurer&&) noexcept;
  ~MeshMeasurer();

  /// Errors: kUnsupportedData where a triangle names a point that the mesh does not have, a point
  ///   is not finite, or the mesh covers no post; kCancelled.
  /// Cost: near one pass over posts, triangles and sampled lines; bounded on any input. The first
  ///   call also samples the DEM.
  [[nodiscard]] Result<MeshError> Measure(const PlacedMesh& mesh, const RunControl& control);

  /// Measures several meshes, one a thread at a time.
  /// threads: never changes the result. Errors: those of Measure, of the first mesh that has one.
  [[nodiscard]] Result<std::vector<MeshError>> MeasureAll(std::span<const PlacedMesh> meshes,
                                                          int threads, const RunControl& control);

 private:
  struct Dem;
  [[nodiscard]] Result<MeshError> MeasurePrepared(const PlacedMesh& mesh,
                                                  const RunControl& control) const;

  std::unique_ptr<Dem> dem_;
};

}  // namespace farhorizon
