#include "service/auth/key_meter.h"

#include <algorithm>
#include <cmath>

namespace farhorizon {

namespace {

constexpr double kMinuteMs = 60'000;
constexpr double kHourMs = 3'600'000;

// Levels are in units of which each millisecond adds `bound`, so that one request, or byte, takes
// as many as the period has milliseconds: whole numbers, which are exact.
double Fill(double level, std::int64_t bound, double period_ms, double passed_ms) {
  const double most = static_cast<double>(bound) * period_ms;
  return std::min(most, level + static_cast<double>(bound) * passed_ms);
}

// Seconds until `level` is enough for one.
std::int64_t SecondsToOne(double level, std::int64_t bound, double period_ms) {
  const double ms = (period_ms - level) / static_cast<double>(bound);
  return std::max<std::int64_t>(1, std::llround(std::ceil(ms / 1000)));
}

}  // namespace

KeyMeter::Buckets& KeyMeter::Filled(const std::string& owner, std::int64_t now_ms) {
  const auto [found, is_new] = owners_.try_emplace(owner);
  Buckets& buckets = found->second;
  const double passed =
      is_new ? kHourMs : static_cast<double>(std::max<std::int64_t>(0, now_ms - buckets.filled_ms));
  buckets.requests = Fill(buckets.requests, bounds_.requests_per_minute, kMinuteMs, passed);
  buckets.bytes = Fill(buckets.bytes, bounds_.upload_bytes_per_hour, kHourMs, passed);
  buckets.filled_ms = now_ms;
  return buckets;
}

std::int64_t KeyMeter::TakeRequest(const std::string& owner, bool uploads, std::int64_t now_ms) {
  const std::lock_guard lock(mutex_);
  Buckets& buckets = Filled(owner, now_ms);
  const std::int64_t requests = bounds_.requests_per_minute;
  if (requests > 0 && buckets.requests < kMinuteMs) {
    return SecondsToOne(buckets.requests, requests, kMinuteMs);
  }
  const std::int64_t bytes = bounds_.upload_bytes_per_hour;
  if (uploads && bytes > 0 && buckets.bytes <= 0) {
    return SecondsToOne(buckets.bytes, bytes, kHourMs);
  }
  if (requests > 0) buckets.requests -= kMinuteMs;
  return 0;
}

void KeyMeter::TakeBytes(const std::string& owner, std::int64_t bytes, std::int64_t now_ms) {
  const std::lock_guard lock(mutex_);
  if (bounds_.upload_bytes_per_hour > 0) {
    Filled(owner, now_ms).bytes -= static_cast<double>(bytes) * kHourMs;
  }
}

}  // namespace farhorizon
