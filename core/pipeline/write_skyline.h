#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/lines_of_sight/upper_envelope.h"
#include "core/pipeline/build_options.h"
#include "core/pipeline/ground_step.h"

namespace farhorizon {

enum class SkylineFormat { kGeoJson, kSvg };

/// The format that the ending of `file` names. Errors: kInvalidArgument, kind "unknown-format", for
/// another ending than ".geojson" or ".svg".
Result<SkylineFormat> SkylineFormatOf(const std::filesystem::path& file);

/// The direction in the grid with the azimuth `azimuth_deg`, degrees clockwise from true north,
/// where a step on the ground is `step`: the nearest of those whose numbers are small enough, in
/// lowest terms. It is as a rule within 10^-10 degrees, and within 10^-5 where it is that near to a
/// row, a column or a diagonal.
ViewDirection DirectionOf(double azimuth_deg, const GroundStep& step);

/// The skyline of `dem` for viewers far away who look towards `azimuth`, as the text of a file
/// (io/skyline_features.h, io/skyline_svg.h). Lines of sight are straight and parallel in the DEM's
/// own grid.
///
/// azimuth: degrees clockwise from true north at the DEM's middle. What is written is the azimuth
/// of DirectionOf, to 10^-9 degrees.
/// Errors: kInvalidArgument, kind "bad-azimuth", where the azimuth is not from -360 to 360; those
///   of TerrainInput::Open, FindHorizon and FindLinesOfSight.
Result<std::string> WriteSkyline(const std::filesystem::path& dem, double azimuth,
                                 SkylineFormat format, const BuildOptions& options,
                                 const RunControl& control);

}  // namespace farhorizon
