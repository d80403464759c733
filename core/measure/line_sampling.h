#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/measure/skyline_net.h"

namespace farhorizon {

/// The greatest heights of a surface over a sample of plan lines.
///
/// The sample is regular and uniform in the measure of lines, direction times distance
/// [Crofton1868], over a grid of columns x rows posts, in the plan where a column is as wide as a
/// row: 192 directions, two lines a cell. It is the same at every call.
///
/// heights: one a line, metres; minus infinity where the line misses the surface. outline: 1 where
///   the highest segment is on the outline.
struct SampledSkyline {
  std::vector<double> heights;
  std::vector<std::uint8_t> outline;
};

/// Errors: kCancelled. Cost: the lines that each segment crosses, in each direction.
Result<SampledSkyline> SampleSkyline(const SkylineNet& net, std::int32_t columns, std::int32_t rows,
                                     const RunControl& control);

/// The difference of two skylines over the lines that meet both surfaces, metres.
///
/// max_m, outline_max_m: the greatest on lines with neither, and with either, of the two on its
/// outline. rms_m: over all.
struct SampledError {
  double rms_m = 0;
  double max_m = 0;
  double outline_max_m = 0;
};

/// Requires: both over the same sample.
SampledError Compare(const SampledSkyline& first, const SampledSkyline& second);

}  // namespace farhorizon
