#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// What the coordinates of a mesh are, the third being its height.
enum class MeshFrame {
  kCrs,         ///< the DEM's reference system: x and y of the map, heights as the DEM's
  kLonLat,      ///< degrees of longitude and latitude, metres above the ellipsoid (WGS 84)
  kEcef,        ///< earth-fixed, metres (EPSG:4978); no coordinate is a height
  kTile,        ///< metres east, north and up of farhorizon's frame: Georeference::frame
  kPosts,       ///< columns and rows as the DEM's file has them, heights as the DEM's
  kPostsUp,     ///< the same with rows counted from the last one
  kCorner,      ///< metres from the corner with the least x and y of the map, heights as the DEM's
  kCornerDown,  ///< metres from the corner with the least x and the greatest y, y against the map's
  kCentre,      ///< metres from the middle of the grid, heights as the DEM's
};

/// Which axis of a file is up: of (x, y, z) with y up, (x, -z, y) is the same with z up.
enum class UpAxis { kZ, kY };

/// A name of --mesh-frame: "posts-up".
const char* MeshFrameName(MeshFrame frame);
/// All of them in the order of the enum, separated by commas, for messages and help.
std::string MeshFrameNames();
/// nullopt where no frame has this name.
std::optional<MeshFrame> MeshFrameFromName(std::string_view name);
/// What the frame is, for people: "columns and rows, the first row first".
const char* MeshFrameMeaning(MeshFrame frame);
std::vector<MeshFrame> AllMeshFrames();

/// Whether triangles of that frame are straight on the globe, in Georeference::frame. Those of the
/// others are straight over the grid.
bool IsStraightOnGlobe(MeshFrame frame);

}  // namespace farhorizon
