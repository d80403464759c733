#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/io/draco_mesh.h"
#include "core/io/edge_visibility.h"
#include "core/io/horizon_features.h"
#include "core/measure/mesh_error.h"
#include "core/pipeline/level_artifact.h"
#include "core/pipeline/level_tree.h"
#include "core/pipeline/verify/claims.h"

namespace farhorizon {

/// A level as its files have it. inlined: the edges in its GLBs; empty where they have none.
/// contents: the GLBs and what they cover.
struct StoredLevel {
  DecodedMesh decoded;
  PlacedMesh placed;
  EdgeVisibility inlined;
  std::vector<TileContentRegion> contents;
};

/// What is known of the edges of a level without its files: the horizon edges that it keeps, by
/// their places, and all edges of the horizon with their measures, found again. threads: to look
/// for the others with.
struct KnownEdges {
  const std::vector<std::int32_t>& kept;
  const std::vector<HorizonFeature>& features;
  int threads = 1;
};

/// Checks the edges that a level is said to draw, in lodN-horizon.glb and in lodN.glb: they are
/// found again and compared; random lines have their skyline on them.
/// Cost: that of FindLevelEdges, and 1000 times the mesh's edges.
void VerifyLevelEdges(const LevelContext& context, const std::filesystem::path& directory,
                      const LevelReport& claimed, const StoredLevel& level, const KnownEdges& known,
                      Claims& claims);

}  // namespace farhorizon
