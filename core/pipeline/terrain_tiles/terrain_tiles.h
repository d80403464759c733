#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/pipeline/terrain_tiles/globe_mesh.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// A level that is to be cut into tiles.
struct TiledLevel {
  GlobeMesh mesh;
  double geometric_error_m = 0;
};

/// Takes a finished file. Its errors end the work.
using TerrainSink = std::function<Status(const std::string& name, const std::string& bytes)>;

/// Checks that tiles in longitude and latitude can show the DEM: that no pole is on it.
/// Errors: kUnsupportedData, kind "too-large-extent".
Status CheckOffPoles(const Georeference& georeference, const Dem& dem);

/// Cuts levels into the tiles of quantized-mesh 1.0, and describes them: `layer.json` and, for each
/// tile, `terrain-Z-X-Y.terrain` in gzip, each once, tiles in the order of their numbers.
///
/// Tiles cover their rectangles: beside the ground is the ellipsoid, up to it a wall. Both tiles of
/// zoom 0 are there, and each tile with ground in it down to the last zoom (PlanZooms).
/// levels: level 0 first; their meshes are taken apart. Requires: errors do not fall.
/// Errors: those of CoverBox and of `sink`; kCancelled; kResourceExhausted for want of memory.
/// Cost: O(zooms * triangles).
Status WriteTerrainTiles(std::vector<TiledLevel> levels, const RunControl& control,
                         const TerrainSink& sink);

}  // namespace farhorizon
