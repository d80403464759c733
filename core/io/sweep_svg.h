#pragma once

#include <string>

#include "core/horizon/trace/sweep_trace.h"

namespace farhorizon {

/// A picture of the sweep at a level, north up, a legend with counts beside it: groups of the classes
/// "contours", "hulls", "inactive" and "active" (bitangents), "candidates" and "seen", in drawing order.
/// title: one line, any text. About 1000 pixels wide or high, whatever the terrain; coordinates to a
/// tenth of a pixel. The same trace, the same bytes.
std::string DrawSweep(const SweepTrace& trace, const std::string& title);

}  // namespace farhorizon
