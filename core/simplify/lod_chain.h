#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// What one level may differ from the DEM by.
struct LevelBudget {
  double vertical_error_m = 0;    ///< at every post
  double silhouette_error_m = 0;  ///< over every plan line, up and down
  double longest_edge = 0;        ///< in columns or rows; 0: any
  double least_altitude = 0;      ///< of a triangle in plan, in columns or rows
};

/// One level of detail and what it keeps of the horizon.
struct Lod {
  PostMesh mesh;
  std::vector<std::int32_t> kept;  ///< indices into horizon.edges, rising: edges of this mesh
};

/// A chain of meshes of falling detail, level 0 the finest; one for each budget.
///
/// Vertices are posts of the DEM. The tile's four sides keep all their posts, so that neighbours which
/// are built apart meet without a crack; other rims (of holes, of slanted outlines) keep their shape in
/// plan. No triangle is steeper along either axis of the grid than the DEM's steepest.
/// Each level keeps only horizon edges that the finer one keeps. Where the silhouette budget is 0
/// it keeps all of them and H is exactly the DEM's; elsewhere H is within the budget, exactly. A budget
/// below FinerHeights's step counts as 0.
/// Requires: budgets do not fall from level to level.
/// Errors: kCancelled.
Result<std::vector<Lod>> BuildLodChain(const Terrain& terrain, const Horizon& horizon,
                                       const std::vector<LevelBudget>& budgets, const Watch& watch);

}  // namespace farhorizon
