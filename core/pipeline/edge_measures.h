#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/horizon/lines_of_sight/lines_of_sight.h"
#include "core/pipeline/georeference.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// In what directions and where an edge is on the horizon, and how much it matters, as it is published.
///
/// azimuths: [from, to], degrees clockwise from true north at the edge's middle, 0 <= from < 180,
///   from < to <= from + 180, rising, apart. spans: [t0, t1] in [0, 1], 0 at a, rising, apart. None of an
///   undecided edge.
/// Both are rounded outwards, to kAzimuthStep and kSpanStep: what lies between two that are closer than
/// that is closed.
/// angular_share: the measure of the azimuths over 180. line_measure_m: of the lines on which the edge
///   is the skyline, in radians times metres across; all lines that meet a convex region measure its
///   perimeter [Crofton1868]. True to a millionth of itself.
/// skyline_drop_m: how much lower the skyline would be without it (skyline_drop.h): the truth, or up to
///   kSkylineDropStep less.
struct EdgeMeasures {
  std::vector<std::array<double, 2>> azimuths;
  std::vector<std::array<double, 2>> spans;
  double angular_share = 0;
  double line_measure_m = 0;
  double skyline_drop_m = 0;
};
inline constexpr double kAzimuthStep = 1e-6;
inline constexpr double kSpanStep = 1e-7;
inline constexpr double kSkylineDropStep = 5e-4;

/// Azimuths, spans, share and measure of an edge with the given lines of sight.
/// along: from a to b in columns and rows.
EdgeMeasures MeasuresOf(const LinesOfSight& sights, std::array<double, 2> along,
                        const GroundStep& step);

/// One for each edge of the horizon. The same for any `threads`.
/// Errors: kCancelled; those of placing points.
Result<std::vector<EdgeMeasures>> MeasureEdges(const Terrain& terrain, const Horizon& horizon,
                                               const Georeference& georeference, int threads,
                                               const Watch& watch);

}  // namespace farhorizon
