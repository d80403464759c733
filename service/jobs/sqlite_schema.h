#pragma once

#include "service/jobs/sqlite.h"

namespace farhorizon {

/// Makes `database` ready for the job store: sets what durability needs, creates the tables `jobs`,
/// `artifacts` and `idempotency_keys` in a new file, brings an older schema forward and checks the
/// pages (quick_check).
/// Errors: throws SqliteFailure where the file has no job store of farhorizon, one of a newer
///   version or a damaged one.
void PrepareSchema(Database& database);

}  // namespace farhorizon
