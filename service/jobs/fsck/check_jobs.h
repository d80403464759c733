#pragma once

#include "service/jobs/fsck/fsck_run.h"
#include "service/jobs/sqlite.h"

namespace farhorizon {

/// Looks at the rows of all jobs and at whose the objects are. Requires: run.good is complete.
void CheckJobs(FsckRun& run, Database& database);

}  // namespace farhorizon
