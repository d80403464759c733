#pragma once

#include "core/base/result.h"
#include "core/io/local_mesh.h"
#include "core/io/quantization_lattice.h"
#include "core/pipeline/georeference.h"
#include "core/simplify/lod_chain.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// What the positions of one level are rounded to: whole multiples of a step, counted from the
/// local frame's origin. Both are powers of two, metres.
///
/// sides_m: of vertices on the tile's four sides. It follows from what neighbours share (cell size,
/// the level's number, what was asked), so that in one frame their vertices on a common side are
/// equal bit for bit. inside_m: of all others, sides_m or a power of two finer, by the level's own
/// error.
struct LatticeSteps {
  double sides_m = 0;
  double inside_m = 0;
};

/// The greatest step of level 0's sides for an error that is asked for; 0: for any.
///
/// Where rows of posts are between 175 2^k and 350 2^k metres apart, the step is 2^k metres. Two
/// tiles of a grid have the same step although the globe gives their cells sizes that differ by a
/// percent or two: customary cells (1, 2, 3, 5, 10, 25, 30, 90 m; 1", 3") are further than that
/// from where the step changes. It is half a metre at most, half of what heights are given in over
/// wide cells: ground does not get rougher as cells get wider.
double FinestSideStep(const Georeference& georeference, double max_error_m);

/// The steps of level `number`: sides twice as coarse from level to level, but never beyond a 16th
/// of the shorter side of a cell, where roundings could flip a triangle that is a tenth of a cell
/// high.
///
/// Rounding by a step moves a skyline by about a quarter of it (measured on mountains, hills and
/// lidar, all steps from a 32nd to a 1024th of a cell). The inside of a level whose skyline is not
/// exact gets 5/4 of its silhouette rms, which adds a twentieth to it at most, and a 32nd of its
/// vertical rms at least; that of an exact level a quarter of its vertical rms, so that rounding
/// moves its skyline by a 16th of what its ground is off.
LatticeSteps StepsOfLevel(double finest_side_m, const Georeference& georeference, const Lod& lod,
                          int number);

/// Rounds a level's positions by `steps`, which are made coarser where kMaxLatticeBits do not reach
/// over the level and room_m metres below it, and finer where rounding would flip a triangle;
/// returns the lattice of the inside, on which all of them lie, with that room below them, and sets
/// `steps` to what was taken.
/// Errors: kUnsupportedData, kind "flipped-triangle", where no step leaves every triangle
///   counter-clockwise from above.
Result<QuantizationLattice> RoundToLattice(const Dem& dem, const TangentFrame& frame,
                                           LatticeSteps& steps, LocalMesh& mesh, double room_m = 0);

}  // namespace farhorizon
