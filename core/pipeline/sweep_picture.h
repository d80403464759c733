#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/pipeline/build_options.h"

namespace farhorizon {

/// Writes a picture of the sweep over `dem`, its plane at a height, as SVG (io/sweep_svg.h).
///
/// height_m: of the plane, in the DEM's vertical datum; rounded to a quantum of its heights.
/// Errors: kInvalidArgument for another ending than ".svg", kind "unknown-format", and where the
///   plane cuts no ground, kind "no-such-level", with the heights at which it does; those of
///   TerrainInput::Open and TraceSweep.
Status WriteSweepPicture(const std::filesystem::path& dem, const std::filesystem::path& out,
                         double height_m, const BuildOptions& options, const RunControl& control);

}  // namespace farhorizon
