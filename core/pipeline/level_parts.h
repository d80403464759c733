#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/io/local_mesh.h"
#include "core/terrain/dem.h"
#include "core/terrain/part_grid.h"

namespace farhorizon {

/// A part of a level: which one of the level's PartGrid, counted from the DEM's first column and
/// row.
struct PartPlace {
  std::int32_t column = 0;
  std::int32_t row = 0;
  friend bool operator==(const PartPlace&, const PartPlace&) = default;
};

/// A part and its triangles.
struct MeshPart {
  PartPlace place;
  LocalMesh mesh;
};

/// The file of a part: "lod0.glb" of a level that is not cut, "lod0-1-2.glb" of the part at column
/// 1 and row 2 of one that is.
std::string PartGlbName(int level, const PartDepth& depth, const PartPlace& place);

/// The parts of a level that have triangles, row by row. Vertices on a line are in all parts there.
/// depth: that of the level. Requires: no triangle crosses a line; `mesh` has posts.
/// Cost: O(n log n).
std::vector<MeshPart> CutIntoParts(const LocalMesh& mesh, const Dem& dem, const PartDepth& depth);

/// Meshes as one: their triangles in turn, vertices by rising posts, those that are alike in all
/// they have once. Cost: O(n log n).
LocalMesh JoinMeshes(const std::vector<LocalMesh>& meshes);

}  // namespace farhorizon
