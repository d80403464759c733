#pragma once

#include <string>

#include "core/horizon/trace/sweep_trace.h"

namespace farhorizon {

/// Draws the sweep with its plane at a height, as SVG, north up, with a legend of counts beside it.
///
/// The groups have the classes "contours", "hulls", "inactive" and "active" (bitangents),
/// "candidates" and "seen", in drawing order. The picture is about 1000 pixels wide or high,
/// whatever the terrain; coordinates are to a tenth of a pixel. title: one line, any text.
/// Same trace and title, same bytes.
std::string DrawSweep(const SweepTrace& trace, const std::string& title);

}  // namespace farhorizon
