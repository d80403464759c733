#pragma once

#include "service/jobs/fsck/fsck_run.h"
#include "service/jobs/sqlite.h"

namespace farhorizon {

/// Looks at the uploads that clients may go on with: each has all of the bytes that it says, with
/// no gap. --repair removes the others, for their clients to begin anew. Throws: SqlFailure.
/// Requires: run.good is known.
void CheckUploads(FsckRun& run, Database& database);

}  // namespace farhorizon
