#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/measure/mesh_error.h"
#include "core/pipeline/terrain_input.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// What was compared: mesh, over the grid of `terrain`, which is the DEM's or a part of it.
struct ComparedMesh {
  const TerrainInput& input;
  const Terrain& terrain;
  const Horizon& horizon;
  const PlacedMesh& mesh;
  const PostPlaces& places;
  std::string title;
  std::vector<std::string> lines;  ///< of figures, below the title
};

/// A picture of a mesh against a DEM (DrawComparisonSvg): skylines in four directions, and a map of
/// the vertical error where the mesh is straight.
/// Errors: those of SkylinePairs and HeightsOverPosts.
Result<std::string> DrawComparison(const ComparedMesh& compared);

}  // namespace farhorizon
