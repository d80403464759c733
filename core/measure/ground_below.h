#pragma once

#include <optional>

#include "core/terrain/dem.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// The DEM's ground below a piece of a segment that lies in one of its triangles.
///
/// from_m, to_m: its heights at both ends, metres. cell: the first post of the cell there.
struct GroundPiece {
  double from_m = 0;
  double to_m = 0;
  VertexId cell = 0;
};

/// The ground below the piece from p to q; nullopt where there is none, or the cell has fewer than
/// four posts. extend: of a cell of three posts their plane, all over the cell.
/// Requires: the piece lies in one triangle, or outside the grid.
std::optional<GroundPiece> GroundBelow(const Dem& dem, const GridPoint& p, const GridPoint& q,
                                       bool extend);

}  // namespace farhorizon
