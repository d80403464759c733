#pragma once

#include <cstdint>

#include "service/jobs/sqlite.h"

namespace farhorizon {

/// The version of the tables that PrepareSchema makes.
extern const std::int64_t kSchemaVersion;

/// Makes `database` ready for the job store: sets what durability needs, checks the pages
/// (quick_check), creates the tables in a new file and brings an older schema forward: `jobs`,
/// `artifacts`, `idempotency_keys`, `garbage` (objects of removed jobs), `callbacks` and the one
/// row of `store`.
/// Errors: throws SqlFailure where the file has no job store of farhorizon, one of a newer
///   version or a damaged one.
void PrepareSchema(Database& database);

}  // namespace farhorizon
