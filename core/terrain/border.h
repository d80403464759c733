#pragma once

#include <vector>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// Per post, whether it is on the outline of the terrain: an end of an edge with a triangle on one
/// side only.
std::vector<bool> OutlinePosts(const Terrain& terrain);

/// Whether the segment from a to b, in plan, consists of edges of the terrain with a triangle on
/// one side only, the same side for all.
bool RunsAlongOutline(const Terrain& terrain, Edge edge);

/// Whether `v` lies on one of the tile's four sides.
inline bool OnSide(const Dem& dem, VertexId v) {
  const std::int32_t column = dem.Column(v);
  const std::int32_t row = dem.Row(v);
  return column == 0 || row == 0 || column == dem.columns - 1 || row == dem.rows - 1;
}

}  // namespace farhorizon
