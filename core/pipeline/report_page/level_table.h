#pragma once

#include <cstdint>
#include <vector>

#include "core/pipeline/report.h"
#include "core/pipeline/report_page/html.h"
#include "core/pipeline/report_page/skyline_chart.h"

namespace farhorizon {

/// The levels' measures. terrain_triangles: of the whole DEM.
Html LevelTable(const Report& report, std::int64_t terrain_triangles);

/// How far each level's skyline is off on the lines of each set.
Html SkylineTable(const std::vector<SkylineSet>& sets);

}  // namespace farhorizon
