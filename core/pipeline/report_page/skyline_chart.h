#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/pipeline/report_page/html.h"
#include "core/pipeline/report_page/skyline_profile.h"

namespace farhorizon {

/// The skylines of one set of parallel lines: the terrain's, and each level's over the same lines.
struct SkylineSet {
  ParallelLines lines;
  SkylineProfile terrain;
  std::vector<SkylineProfile> levels;
};

/// The number of lines across a chart: three for each of its columns, which shows the one where a
/// level is off most.
inline constexpr int kLinesAcross = 1164;

/// How far a level's skyline is from the terrain's on the lines that both have; zeros where there
/// are none.
struct SkylineDifference {
  double greatest_m = 0;  ///< of both signs
  double rms_m = 0;
};
SkylineDifference DifferenceOf(const SkylineProfile& terrain, const SkylineProfile& level);

/// The scales that all charts of a page have in common.
struct SkylineScale {
  double least_m = 0;  ///< the height at the bottom of the charts
  double pixels_a_metre = 1;
  /// By how much more than heights differences are enlarged: for each level, and for all together.
  std::vector<double> level_factors;
  double common_factor = 1;
};
SkylineScale ScaleOf(const std::vector<SkylineSet>& sets);

/// The chart of one set for someone who looks towards its azimuth, as an <svg>: the terrain's
/// skyline, the levels' over it, and the differences beneath. What belongs to a level has its
/// number in the attribute data-level. The drawing has the id "sky-A", A the azimuth.
Html SkylineChart(const SkylineSet& set, const SkylineScale& scale);
/// The same for someone who looks the other way: the same lines, seen from behind.
/// Requires: SkylineChart(set, scale) is on the page, too.
Html MirroredSkylineChart(const SkylineSet& set, const SkylineScale& scale);

/// The terrain's skyline alone, without axes, for a page's head, from the chart of `set`.
Html SkylineBanner(const SkylineSet& set);

}  // namespace farhorizon
