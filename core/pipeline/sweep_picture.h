#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/pipeline/build.h"

namespace farhorizon {

/// A picture of the sweep over `dem` at the height `level_m` (in the DEM's vertical datum, taken to the
/// nearest quantum of its heights), as SVG: io/sweep_svg.h.
/// Errors: kInvalidArgument for another ending than ".svg", or a level that cuts no ground, with the
/// heights that do; those of reading and of the kinetic engine.
Status WriteSweepPicture(const std::filesystem::path& dem, const std::filesystem::path& out,
                         double level_m, const BuildOptions& options, const Watch& watch);

}  // namespace farhorizon
