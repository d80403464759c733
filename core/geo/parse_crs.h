#pragma once

#include <string>

#include "core/base/result.h"
#include "core/geo/crs_text.h"
#include "core/geo/proj_session.h"

namespace farhorizon {

/// The reference system that `text` names, after CompletedCrsText and CheckCrsText.
/// Errors: those of CheckCrsText; kUnsupportedData, kind "unknown-crs", for what PROJ does not know
///   or does not take for a reference system.
Result<ProjObject> ParseCrs(ProjSession& session, const std::string& text,
                            CrsRole role = CrsRole::kMap);

/// The horizontal part of `crs`, without a shift that is bound to it; null where it has none.
ProjObject PlanOf(const ProjSession& session, const PJconsts* crs);

/// Checks that `plan` is one of maps of the Earth: geographic or projected, on an ellipsoid of the
/// Earth's size. `name` is the one for messages.
/// Errors: kUnsupportedData, kinds "local-crs" and "unknown-crs".
Status CheckPlan(const ProjSession& session, const PJconsts* plan, const std::string& name);

}  // namespace farhorizon
