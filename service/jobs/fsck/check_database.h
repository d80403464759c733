#pragma once

#include "service/jobs/fsck/fsck_run.h"

namespace farhorizon {

/// Looks at the database, and with `repair` takes what can be read out of a damaged one. True where
/// its rows can be looked at.
bool CheckDatabase(FsckRun& run);

}  // namespace farhorizon
