#pragma once

#include <cstdint>

#include "core/pipeline/build_options.h"

namespace farhorizon {

/// What a build is expected to need.
struct BuildCost {
  std::int64_t memory_bytes = 0;  ///< resident at its peak
  double cpu_seconds = 0;         ///< of all threads together, on a core of 2020 that nobody shares
};

/// The cost of a build, from what the header of a DEM says before any height is read: enough for
/// mountains, plains and coasts; ground that is as rough as white noise needs up to three times as
/// much. build_cost.cpp has the measurements.
BuildCost EstimateBuild(std::int64_t posts, const BuildOptions& options);

/// The greatest number of posts whose build is expected to need at most `memory_bytes`.
std::int64_t PostsWithin(std::int64_t memory_bytes, const BuildOptions& options);

}  // namespace farhorizon
