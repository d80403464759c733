#pragma once

#include <string>
#include <vector>

#include "core/io/tileset.h"
#include "core/pipeline/level_parts.h"
#include "core/pipeline/mesh_region.h"
#include "core/pipeline/report.h"

namespace farhorizon {

/// A GLB of a level, and what its surface and its skirt cover.
struct TileContentRegion {
  PartPlace place;
  std::string uri;
  MeshRegion region;
};

/// The tiles of all levels: below each part of a level the parts of the next finer one that cover
/// the same ground, so that these take its place and no other's. The root has the coarsest level.
/// Where that one is cut, too, it has no content, and root_error_m.
///
/// levels, contents: the finest first. Each tile's region has those of all below it, as 3D Tiles
/// asks. Requires: at least one level; no level is cut deeper than the next finer one.
TilesetTile TreeOf(const std::vector<LevelReport>& levels,
                   const std::vector<std::vector<TileContentRegion>>& contents,
                   double root_error_m);

}  // namespace farhorizon
