#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "service/jobs/job_store.h"

namespace farhorizon {

/// How a process uses a store that several share.
struct PostgresStoreOptions {
  std::string url;     ///< a connection URI or string of libpq
  std::string holder;  ///< hexadecimal digits: this process, and the one before it on its folder
  std::chrono::milliseconds lease{30'000};
  int connections = 6;  ///< for calls, and as many again for pins
};

/// Jobs in a PostgreSQL database that any number of processes share, in the schema `farhorizon`.
///
/// Invariants: a call's change is committed before it returns. Insertions follow one another, under
/// an advisory lock: so ids and the bounds of the queue are as with one process. A claim locks no
/// row that another claim has locked, and waits for none. Leases are by the server's clock. Pins
/// are locks of the server, each of its own connection, over which the calls of the thread that has
/// it go. Requires: no pooler between that gives transactions of one client different connections.
///
/// Makes the tables, or brings older ones forward.
/// Errors: kIo "job-store-unusable", with the remedy, where the server cannot be reached, refuses
///   this user or has tables of a newer version.
Result<std::unique_ptr<JobStore>> OpenPostgresJobStore(const PostgresStoreOptions& options);

}  // namespace farhorizon
