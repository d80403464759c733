#pragma once

#include <vector>

#include "core/pipeline/report.h"
#include "core/pipeline/report_page/html.h"

namespace farhorizon {

/// Errors against triangles, both logarithmic, as an <svg>: vertical and silhouette, root mean
/// square and greatest, a point a level. An error of 0 is drawn on the lower side.
/// Requires: a level.
Html ErrorChart(const std::vector<LevelReport>& levels);

}  // namespace farhorizon
