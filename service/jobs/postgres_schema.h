#pragma once

#include "service/jobs/postgres.h"

namespace farhorizon {

/// Makes the database ready for the job store: makes the schema `farhorizon` and its tables, or
/// brings those of an older version forward, in one transaction. Of several processes that start at
/// once, one does, and the others wait for it.
/// Errors: throws SqlFailure, "job-store-unusable" where the tables are of a newer version, or the
///   database's encoding is not UTF-8.
void PreparePostgresSchema(PostgresDatabase& database);

}  // namespace farhorizon
