#pragma once

#include <string>

#include "core/io/skyline_features.h"

namespace farhorizon {

/// Draws a skyline as SVG: the ground against the sky, heights exaggerated by the factor that the
/// picture states, and each part the lighter the farther away it is.
///
/// title: one line, any text. Same skyline and title, same bytes.
std::string DrawSkyline(const SkylineOfDirection& skyline, const std::string& title);

}  // namespace farhorizon
