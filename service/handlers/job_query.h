#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/result.h"
#include "service/jobs/job_store.h"

namespace farhorizon {

/// What GET /jobs asks for.
struct JobListRequest {
  JobQuery query = {};
  bool none = false;  ///< it is jobs of a type that there are none of
};

/// Reads the parameters limit, status, type, processID, datetime, minDuration, maxDuration and
/// cursor. Errors: kInvalidArgument "invalid-query-parameter-value".
Result<JobListRequest> ReadJobQuery(const Parameters& parameters, std::int64_t now_ms);

/// The milliseconds since 1970 that a date and time of [RFC 3339] lasts: the first and the last. A
/// time without a fraction lasts a second, a date without a time a day. nullopt for other text.
std::optional<std::pair<std::int64_t, std::int64_t>> InstantIn(std::string_view text);

}  // namespace farhorizon
