#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// By how much one level may differ from the DEM.
struct LevelBudget {
  double vertical_error_m = 0;    ///< at every post
  double silhouette_error_m = 0;  ///< over every plan line, up and down
  double longest_edge = 0;        ///< in columns or rows; 0: any
  double least_altitude = 0;      ///< of a triangle in plan, in columns or rows
};

/// What a chain of levels is asked for.
///
/// triangles: for each level the most triangles that it may have, falling. Empty: levels by size,
///   each further level with 2/5 of the triangles of the one before, none but level 0 with fewer
///   than 500.
/// levels: how many by size, at most. max_error_m: what level 0 by size may be off at a post.
/// silhouette_error_m: what level 0 by size may be off at a line; 0: exact.
/// column_bend, row_bend: the Earth's drop below the tangent plane at a distance of dc columns and
///   dr rows is column_bend * dc^2 + row_bend * dr^2 metres; edges are straight in that plane.
struct LodPlan {
  std::vector<std::int64_t> triangles;
  int levels = 5;
  double max_error_m = 0;
  double silhouette_error_m = 0;
  double column_bend = 0;
  double row_bend = 0;
};

/// One level of detail and the horizon edges that it keeps.
///
/// kept: indices into horizon.edges, rising: edges of this mesh. exact: before rounding, the
/// skyline is the DEM's. vertical_rms_m, silhouette_rms_m: about how far the level is off.
struct Lod {
  PostMesh mesh;
  std::vector<std::int32_t> kept;
  bool exact = false;
  double vertical_rms_m = 0;
  double silhouette_rms_m = 0;
};

/// A chain of meshes, level 0 the finest, one for each budget.
///
/// (1) Vertices are posts of the DEM. The tile's four sides keep all their posts, so that
///     neighbours that are built apart meet without a crack; other borders (of holes, of slanted
///     outlines) keep their shape in plan.
/// (2) No triangle is steeper along either axis of the grid than the DEM's steepest.
/// (3) Each level keeps only horizon edges that the finer one keeps.
/// (4) H is within the silhouette budget, exactly. Where the budget is 0, or below a step of
///     FinerHeights, the level keeps all horizon edges and H is exactly the DEM's.
/// Requires: budgets do not fall from level to level.
/// Errors: kCancelled.
Result<std::vector<Lod>> BuildLodChain(const Terrain& terrain, const Horizon& horizon,
                                       const std::vector<LevelBudget>& budgets,
                                       const RunControl& control);

/// The same for a plan, by budgets that double from level to level.
/// Errors: kCancelled.
Result<std::vector<Lod>> BuildLodChain(const Terrain& terrain, const Horizon& horizon,
                                       const LodPlan& plan, const RunControl& control);

}  // namespace farhorizon
