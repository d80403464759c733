#pragma once

#include <vector>

#include "core/base/run_control.h"
#include "core/io/manifest.h"
#include "core/pipeline/report.h"
#include "core/pipeline/report_page/html.h"

namespace farhorizon {

/// Where the bytes went: every artifact, with bytes a triangle or a horizon edge.
Html BytesTable(const Report& report, const std::vector<ManifestEntry>& artifacts);

/// Where the time went, by stage in the order of kStages; a sentence that says where to find it
/// where nothing was measured.
Html TimesTable(const StageSeconds& seconds);

}  // namespace farhorizon
