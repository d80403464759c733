#pragma once

#include <optional>
#include <vector>

#include "core/io/mesh_files/file_mesh.h"
#include "core/pipeline/compare/mesh_placing.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

/// What is taken of a mesh in metres from a corner: kStated: its cells are the DEM's and it is
/// counted from there; kWhole: it reaches over the whole DEM, whatever its cells and its origin.
enum class Extent { kStated, kWhole };

/// How a mesh lies on the DEM under one placing, by a sample of its triangles.
///
/// least, greatest: the box of the mesh, columns, rows, metres. inside: the share of sampled
///   corners over the DEM's box, one cell around it included. coverage: the share of the DEM's box
///   that the mesh's box covers. correlation: of the mesh's heights with the DEM's, weighted by
///   area in plan; 1 where both are level, 0 where one is, or nothing can be compared.
struct FrameFit {
  MeshPlacing placing;
  Extent extent = Extent::kStated;
  GridPoint least;
  GridPoint greatest;
  double inside = 0;
  double coverage = 0;
  double correlation = 0;
  std::vector<GridPoint> sample;

  /// Whether the mesh lies within the DEM's box, except at the rim, and is no line there.
  [[nodiscard]] bool Lies() const;
  /// How badly the heights follow the DEM's: 0 where a straight line maps one to the other.
  [[nodiscard]] double Misfit() const;
};

/// A sample of a mesh: up to 4096 triangles at regular distances, and the points that reach
/// furthest along each axis of the file, behind the triangles' corners.
struct MeshSample {
  std::vector<FilePoint> corners;  ///< three a triangle
  std::vector<FilePoint> extremes;
};
MeshSample SampleOf(const FileMesh& mesh);

/// nullopt where a point of the sample has no place in the DEM's reference system.
std::optional<FrameFit> FitFrame(const MeshSample& sample, MeshPlacing placing, Extent extent,
                                 const TerrainInput& input);

/// Whether two placings put the sample at about the same places in plan, within 3 % of the DEM's
/// longer side: on one plan, that is, and not turned or mirrored.
bool OnOnePlan(const FrameFit& a, const FrameFit& b, const Dem& dem);

}  // namespace farhorizon
