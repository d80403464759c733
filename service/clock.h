#pragma once

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>

namespace farhorizon {

/// Milliseconds since 1970, UTC; never less than an earlier answer in this process.
std::int64_t NowMs();

/// RFC 3339 in UTC with milliseconds: "2026-01-31T12:00:00.000Z".
std::string FormatTime(std::int64_t ms);

/// The form of HTTP's Date field: "Sat, 31 Jan 2026 12:00:00 GMT".
std::string FormatHttpDate(std::int64_t ms);

/// Waits for `time`, or until a stop is requested if that is earlier.
void Pause(std::chrono::milliseconds time, const std::stop_token& stop);

}  // namespace farhorizon
