#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/mesh_files/file_mesh.h"
#include "core/io/mesh_files/placing_matrix.h"

namespace farhorizon {

/// Content of a tile of a tileset.
struct TileContent {
  std::string uri;             ///< as the tileset has it
  std::filesystem::path file;  ///< beside the tileset or below it
  PlacingMatrix placing =
      kIdentity;  ///< from the content's axes, after glTF's nodes, to the root's
  int depth = 0;  ///< tiles with content above it
  double geometric_error_m = 0;
};

/// The content of every tile of a tileset with explicit tiling [3D Tiles], of the tilesets that it
/// names, too: the root first, a tile's children after it. The turn from glTF's y up is part of
/// `placing` (gltfUpAxis of version 1.0 is obeyed).
/// Errors: "bad-mesh-file", also for implicit tiling, for tilesets in a circle and for tiles with
///   files that lie elsewhere (PathBeside); "mesh-too-large" beyond 4096 contents; kNotFound, kIo.
Result<std::vector<TileContent>> ReadTiles(const std::filesystem::path& tileset);

}  // namespace farhorizon
