#pragma once

#include <cstdint>
#include <string>

namespace farhorizon {

/// Milliseconds since 1970, UTC; never less than an earlier answer in this process.
std::int64_t NowMs();

/// RFC 3339 in UTC with milliseconds: "2026-01-31T12:00:00.000Z".
std::string FormatTime(std::int64_t ms);

/// As HTTP's Date field has it: "Sat, 31 Jan 2026 12:00:00 GMT".
std::string FormatHttpDate(std::int64_t ms);

}  // namespace farhorizon
