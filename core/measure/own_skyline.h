#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// A side of a mesh's triangles, between the points a < b.
///
/// lines: how many of the sampled lines have the mesh's greatest height on it.
/// directions: bit i is set where one of them has a direction [cos t, sin t], in columns and rows,
///   with t in [i, i + 1] pi / 64.
struct SkylineSide {
  std::int32_t a = 0;
  std::int32_t b = 0;
  std::int64_t lines = 0;
  std::uint64_t directions = 0;
};

/// Sides of a mesh that have nearly all of its own skyline.
///
/// sides: rising by (a, b): those that were known, and those that some sampled line needs.
/// lines: how many lines were sampled and meet the mesh.
/// missed_share: the share of all lines, in the measure of lines, on which the mesh is higher than
///   all of `sides`: an estimate.
struct OwnSkyline {
  std::vector<SkylineSide> sides;
  std::int64_t lines = 0;
  double missed_share = 0;
};

/// Finds where a mesh has its greatest height over plan lines, on a regular sample of them, uniform
/// in the measure of lines [Crofton1868], which grows until missed_share is below kMissedShare, or
/// has doubled four times.
///
/// A side that is not known is taken only where a line's greatest height is on it, more than a
/// micrometre above all that is taken already: none is guessed.
/// What is missed is estimated by the lines on sides that the lines of one direction alone have
/// shown [Good53]: so much each direction would miss, were it not sampled. Directions between them
/// are half as far from one that is, so they miss less.
/// known: sides that count as taken, pairs of points a < b; those that are no side are left out.
/// Requires: `mesh` is welded (WeldedMesh). threads: never changes the result.
/// Errors: kCancelled. Cost: for each of 192 directions, up to 31 times as many, the lines, two a
///   cell, that each ridge of the mesh crosses.
Result<OwnSkyline> FindOwnSkyline(const GridMesh& mesh,
                                  const std::vector<std::array<std::int32_t, 2>>& known,
                                  int threads, const RunControl& control);

/// What FindOwnSkyline looks for: less than what a level may leave out of its horizon edges, for
/// the estimate is one.
inline constexpr double kMissedShare = 0.004;

}  // namespace farhorizon
