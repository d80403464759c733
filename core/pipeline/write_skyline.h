#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/lines_of_sight/upper_envelope.h"
#include "core/pipeline/build.h"
#include "core/pipeline/georeference.h"

namespace farhorizon {

enum class SkylineFormat { kGeoJson, kSvg };

/// By the ending of a file's name. Errors: kInvalidArgument for another than ".geojson" or ".svg".
Result<SkylineFormat> SkylineFormatOf(const std::filesystem::path& file);

/// The direction of the grid that has an azimuth, given in degrees clockwise from true north, where a step on
/// the ground is `step`: within 10^-5 degrees, and exact where it runs along a row or a column.
ViewDirection DirectionOf(double azimuth, const GroundStep& step);

/// The skyline of `dem` for viewers far away who look towards `azimuth`, in degrees clockwise from true north
/// at the DEM's middle, as the text of a file: io/skyline_features.h. Lines of sight are straight and parallel
/// in the DEM's own grid.
/// Errors: kInvalidArgument where the azimuth is not from -360 to 360; those of reading, placing and
/// sweeping the DEM.
Result<std::string> SkylineOfDem(const std::filesystem::path& dem, double azimuth,
                                 SkylineFormat format, const BuildOptions& options,
                                 const Watch& watch);

}  // namespace farhorizon
