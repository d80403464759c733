#pragma once

#include "core/base/run_control.h"
#include "core/simplify/order/collapse_log.h"
#include "core/simplify/work/workpiece.h"

namespace farhorizon {

/// Takes back the collapses that made edges which rise above the DEM's skyline, so that an exact
/// level's mesh is exact again; vertices around them wait to be rated. Ends the log.
///
/// threads: never changes the result.
/// Requires: the mesh was exact when the log began, and only collapses have changed it.
/// Errors: kCancelled.
/// Cost: a question of the guard for each edge that collapses have made and that still stands.
Status TakeBackRises(Workpiece& work, CollapseLog& log, int threads, const RunControl& control);

}  // namespace farhorizon
