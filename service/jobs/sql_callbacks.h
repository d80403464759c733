#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "service/jobs/callback.h"
#include "service/jobs/sql.h"

namespace farhorizon {

/// The outbox of calls to subscribers, the table `callbacks`: a row for each event of a job that
/// somebody is to be told of, from the job's insertion on. Triggers of the tables make it due in
/// the transaction that changes the job's state, whichever it is, and drop what an end has
/// overtaken (postgres_schema.cpp, sqlite_schema.cpp); with the job the row is removed.

/// Requires: within the transaction that inserts the job.
void InsertSubscriber(const SqlDatabase& database, const std::string& id, const Subscriber& whom);
/// Whom the job has been submitted with.
Subscriber SelectSubscriber(const SqlDatabase& database, const std::string& id);
/// As the calls of these names of JobStore have it.
std::optional<DueCallback> ClaimCallback(SqlDatabase& database, std::chrono::milliseconds lease,
                                         std::int64_t now_ms);
bool EndCallback(const SqlDatabase& database, const DueCallback& callback, CallbackEnd end);
bool RetryCallback(const SqlDatabase& database, const DueCallback& callback,
                   std::chrono::milliseconds delay, std::int64_t now_ms);

}  // namespace farhorizon
