#pragma once

#include <optional>
#include <vector>

#include "core/geo/frames.h"
#include "core/io/local_mesh.h"
#include "core/io/quantization_lattice.h"
#include "core/pipeline/report.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

/// The skirt of a level: walls that hang from the rim of its mesh, at the tile's sides, along other
/// outlines and around holes. They hide the gaps to neighbours and, for who looks from outside, the
/// lack of a back of the ground behind the rim.
///
/// Two vertices a post of the rim, top and bottom: the top is the rim's vertex bit for bit, the
/// bottom depth_m below it along the ellipsoid's normal, rounded to whole steps of `lattice`. Both
/// have the rim vertex's normal, so that the wall is lit as the ground above it. Triangles are
/// counter-clockwise seen from outside. posts: those of the rim.
/// Requires: `surface` has posts, and normals equal at equal posts; depth_m > 0.
/// Cost: O(n log n) for n triangles.
LocalMesh SkirtOf(const LocalMesh& surface, const TangentFrame& frame,
                  const QuantizationLattice& lattice, double depth_m);

/// How deep skirts may be: what lattices leave room for below the ground, metres.
/// asked_m: what the options ask for; nullopt: what SkirtDepths may choose, at most.
double MostSkirtDepth(const TerrainInput& input, std::optional<double> asked_m);

/// The depth of each level's skirt, metres, a whole number of the level's steps.
///
/// asked_m: for all levels; 0: none. nullopt: the level's own error and that of the coarsest, which
/// a neighbour may show beside it, both as measured against the DEM that the tiles share; on top of
/// that a step of the coarsest sides, by which a slope of 45 degrees rises where a rim is rounded
/// aside. It is a 512th of the tile's diagonal at least: thinner walls would be less than a pixel
/// from where the tile fills half a screen, and a rim whose slope faces away would not be drawn.
/// And the relief, so that walls end below all ground: who looks level, or from above, at a tile
/// that stands alone sees none of it, nor the sky, below a high rim.
/// levels: measured, the finest first.
std::vector<double> SkirtDepths(const TerrainInput& input, const std::vector<LevelReport>& levels,
                                std::optional<double> asked_m);

}  // namespace farhorizon
