#pragma once

#include <optional>
#include <vector>

#include "core/pipeline/terrain_tiles/globe_mesh.h"

namespace farhorizon {

/// The most tiles of a build, those without ground aside: a deeper zoom that would need more is
/// left out, and a tile of level 0 is larger instead. Parts of levels have to fit beside them into
/// the 4000 artifacts that a job may have.
inline constexpr std::int64_t kMostTerrainTiles = 800;

/// The error that CesiumJS takes a tile at `zoom` to have, whatever the tile says, metres: that of
/// a regular grid of 65 posts a side, by a quarter of their distance at the equator.
double ClientErrorAt(int zoom);

/// How many tiles of `zoom` a box is in.
std::int64_t CountTiles(int zoom, const PlaceBox& box);

/// What is shown at each zoom, from 0 on: a level; nullopt where the ellipsoid will do.
using ZoomPlan = std::vector<std::optional<std::size_t>>;

/// At each zoom the coarsest level whose error is no more than the client's, or the ellipsoid where
/// no height is; at the last zoom level 0.
///
/// errors_m: the measured error of each level, rising from level 0 on. most_height_m: of all of
/// them, above or below the ellipsoid. box: around the ground.
ZoomPlan PlanZooms(const std::vector<double>& errors_m, double most_height_m, const PlaceBox& box);

}  // namespace farhorizon
