#pragma once

#include "core/pipeline/report.h"
#include "core/pipeline/report_page/html.h"

namespace farhorizon {

/// What was read, as a list of terms.
Html FactsOf(const DemReport& dem);

/// What was assumed, as a list, or a sentence that says that nothing was.
Html AssumptionList(const Assumptions& assumptions);

/// What is exact and what is bounded, as a list. has_geojson: horizon.geojson was asked for.
Html ClaimList(const Report& report, bool has_geojson);

}  // namespace farhorizon
