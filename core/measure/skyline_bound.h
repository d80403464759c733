#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/measure/ground_walk.h"
#include "core/measure/occluded_lines.h"
#include "core/measure/skyline_floor.h"
#include "core/measure/skyline_net.h"

namespace farhorizon {

/// Bounds on how far pieces of one surface are above the skyline of another, metres.
///
/// inner_m: for pieces off the outline of their surface, over all lines that meet both surfaces.
/// outline_m: for pieces of the outline, over those of these lines that do not graze it
///   (kGrazingAngle).
struct RaisedBounds {
  double inner_m = 0;
  double outline_m = 0;
};

/// What can be proven where an error of `attained_m` is attained: more by a fortieth, and by the
/// 10^7th part of the surface's relief, as a proof needs some room.
double WithRoom(double attained_m, double relief_m);

/// A surface that occludes, made ready to be asked.
struct OccludingSurface {
  SkylineNet net;
  NetHull hull;
  double lowest_m = 0;  ///< of the ends of segments
  double relief_m = 0;  ///< from there to the highest

  static OccludingSurface Of(SkylineNet net);
};

/// Raises `bounds`, which have been attained or are allowed, until each of the pieces, lowered by
/// its bound, is nowhere above the surface on a line that meets it.
///
/// A bound that is raised is raised to what some line attains. The result is WithRoom of it. Where
/// the work is at its end the bound becomes the greatest height above what is known of the skyline.
/// floor: over every line that it has a height for, the surface is at or above it.
/// Errors: kCancelled. Cost: see the head of the body; bounded by a multiple of segments + pieces.
Result<RaisedBounds> BoundRaised(const OccludingSurface& surface, const SkylineFloor& floor,
                                 const std::vector<RaisedPiece>& pieces, const RaisedBounds& bounds,
                                 const RunControl& control);

}  // namespace farhorizon
