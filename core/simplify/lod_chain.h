#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/terrain/mesh.h"
#include "core/terrain/part_grid.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// What a chain of levels is asked for.
///
/// triangles: for each level the most triangles that it may have, falling. Empty: levels by size,
///   each with 2/5 of the triangles of the one before, none but level 0 with less than 500.
/// levels: how many by size, at most.
/// max_error_m: what level 0 by size may be off at a post.
/// silhouette_error_m: by how much level 0 by size may rise above the DEM's skyline; 0: not at all.
/// threads: never changes the chain.
/// part_triangles: a level of more is cut into parts of so many in the mean (PartGrid), as far as
///   its sides allow (SidePartDepth); 0: none is.
/// column_bend, row_bend: the Earth's drop, metres, at one column or row from the tile's middle: it
///   grows with the square of the distance. Edges are straight in the tile's frame.
struct LodPlan {
  std::vector<std::int64_t> triangles;
  int levels = 5;
  double max_error_m = 0;
  double silhouette_error_m = 0;
  double column_bend = 0;
  double row_bend = 0;
  std::int64_t part_triangles = 0;
  int threads = 1;
};

/// One level of detail.
///
/// kept: the horizon edges that are edges of this mesh in plan and of the finer ones, by their
///   index in horizon.edges, rising.
/// exact: the mesh has all of them at the DEM's heights, and its skyline is the DEM's.
/// parts: no edge of the mesh crosses a line of the PartGrid of that depth; not deeper than that of
///   the finer level.
/// vertical_rms_m, silhouette_rms_m: as simplifying sees them, at posts in the tile's frame and
///   over the lines that it samples. Estimates, for who has to round the mesh; core/measure
///   measures.
struct Lod {
  PostMesh mesh;
  std::vector<std::int32_t> kept;
  bool exact = false;
  PartDepth parts;
  double vertical_rms_m = 0;
  double silhouette_rms_m = 0;
};

/// A chain of meshes, level 0 the finest (core/simplify/README.md).
///
/// (1) Vertices are posts of the DEM in plan; the domain is the DEM's. No triangle is flipped or
///     flat in plan.
/// (2) Level 0 by size is exact, and so is a level of `triangles` in which all horizon edges fit:
///     it keeps every horizon edge and H is exactly the DEM's.
/// (3) A further level is as good as so many triangles can be made in both errors together.
/// (4) Each level keeps only horizon edges that the finer one keeps.
/// (5) Which posts of the tile's four sides a level keeps, and their heights, depend on the side's
///     own heights and on the level's number (by size) or its share of all triangles (otherwise)
///     alone.
/// A level of `triangles` has more than asked for where sides and outlines need them.
/// Requires: triangles fall, or levels >= 1. Errors: kCancelled.
/// Cost: O(n) lists and some microseconds a post for the whole chain; 150 bytes a post.
Result<std::vector<Lod>> BuildLodChain(const Terrain& terrain, const Horizon& horizon,
                                       const LodPlan& plan, const RunControl& control);

}  // namespace farhorizon
