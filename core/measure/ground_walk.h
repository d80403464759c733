#pragma once

#include <cstdint>
#include <vector>

#include "core/horizon/horizon.h"
#include "core/measure/horizon_index.h"
#include "core/measure/mesh_sides.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// A piece of a segment of one surface that may be above the skyline of the other.
///
/// outline: its surface ends there, or the other one does not reach there.
/// near_outline: that is so within about a cell.
struct RaisedPiece {
  GridPoint a;
  GridPoint b;
  bool outline = false;
  bool near_outline = false;
};

/// Where the edges of two surfaces are above the other one's ground.
///
/// mesh_raised: the pieces of the mesh's ridges and outline that are more than `allowed_m` above
///   the DEM's ground, or have none, and are in no merged hull of it: only there can the mesh's
///   skyline be above the DEM's by more. Pieces are at most a few cells long.
/// dem_raised: the horizon edges that are anywhere more than `allowed_m` above the mesh, or have
///   none of it below.
/// sunk_m: of each horizon edge, how far it is above the mesh at most, metres; infinity where it
///   has none of it below.
/// most_m: the greatest difference of heights met, metres; infinity where a piece has no ground
///   below.
/// common_m: at least the greatest difference over the part of the plan that both surfaces have,
///   metres: it is attained at a post or where a side of the mesh crosses the grid.
struct GroundWalk {
  std::vector<RaisedPiece> mesh_raised;
  std::vector<RaisedPiece> dem_raised;
  std::vector<double> sunk_m;
  double most_m = 0;
  double common_m = 0;
};

/// rise: as PostErrors has it. allowed_m: infinity where sunk_m is all that is wanted.
/// Cost: the cells that the mesh's sides cross.
GroundWalk WalkGround(const Terrain& terrain, const Horizon& horizon, const HorizonIndex& index,
                      const GridMesh& mesh, const MeshSides& sides, const std::vector<float>& rise,
                      double allowed_m);

}  // namespace farhorizon
