#pragma once

#include <vector>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// The posts at the rim of the terrain: ends of an edge with a triangle on one side only.
std::vector<bool> OutlinePosts(const Terrain& terrain);

/// Per post: whether it lies on one of the tile's four sides and the simplified side keeps it.
///
/// Each straight run of posts with data is split where it is farthest from its chord while that is
/// more than `tolerance` (quanta) or the chord is longer than `longest` (columns or rows; 0: any)
/// [DouglasPeucker73]. It sees the side's own heights and nothing else, so that the neighbour beyond
/// the side, built by itself, keeps the same posts.
/// Properties: a greater tolerance keeps a subset. Corners and ends of runs always stay.
std::vector<bool> KeptSidePosts(const Dem& dem, double tolerance, double longest);

/// Whether `v` lies on one of the tile's four sides.
inline bool OnSide(const Dem& dem, VertexId v) {
  const std::int32_t column = dem.Column(v);
  const std::int32_t row = dem.Row(v);
  return column == 0 || row == 0 || column == dem.columns - 1 || row == dem.rows - 1;
}

}  // namespace farhorizon
