// What is judged on the ground: heights at the posts, the facets' tilt, the triangles' shape.
#pragma once

#include <cstdint>

#include "grid.h"

namespace farhorizon::peers {

/// Size of the grid's cells, metres.
struct Cell {
  double x, y;
};

/// Error of a mesh in height at the posts, metres.
struct VerticalErrors {
  double rms = 0;
  double max = 0;
  std::int64_t uncovered =
      0;  ///< posts of the DEM's triangles over which there is no mesh: in no error
};
[[nodiscard]] VerticalErrors VerticalErrorsOf(const Mesh& mesh, const Grid& grid);

/// How the mesh looks when lit: the angle between the normals of a facet of the DEM and of the
/// facet of the mesh over its middle, rms over all facets of the DEM (they are alike in plan),
/// degrees.
[[nodiscard]] double FacetAngleRms(const Mesh& mesh, const Grid& grid, Cell cell);

/// The share of triangles, in [0, 1], with an angle under `degrees` in space: the eye sees them as
/// streaks.
[[nodiscard]] double NeedleShare(const Mesh& mesh, Cell cell, double degrees);

}  // namespace farhorizon::peers
