#pragma once

#include <vector>

#include "core/io/quantized_mesh/layer_json.h"
#include "core/io/quantized_mesh/quantized_mesh.h"
#include "core/pipeline/terrain_tiles/globe_mesh.h"

namespace farhorizon {

/// A part in a tile's coordinates. has_fill: there is more than ground in it. moved_m: no place of
/// the part's surface is further from the tile's, height and plan taken together, than this and the
/// error of the level.
struct QuantizedPart {
  QuantizedTile tile;
  bool has_fill = false;
  double moved_m = 0;
};

/// The step of heights of vertices on the sides of tiles: a power of two, so that
/// kMostQuantized steps hold heights from least_m to greatest_m.
double HeightStepOf(double least_m, double greatest_m);

/// Rounds a part to the tile that it fills.
///
/// Vertices on a tile's side, and only they, are on it after rounding, and two tiles of one zoom
/// get the same vertices on the side that they share: heights there are multiples of height_step_m,
/// elsewhere of a finer step. Vertices of the ground that fall on one place become one, the
/// highest, so that no skyline sinks; triangles without an area, upright ones aside, are left out.
///
/// address: its x counts from the meridian of 180 degrees west, also beyond the globe's tiles.
/// Requires: the part lies within the tile, and its heights within those of height_step_m.
QuantizedPart QuantizePart(const TileAddress& address, const GlobePart& part,
                           const std::vector<GlobeVertex>& vertices, double height_step_m);

}  // namespace farhorizon
