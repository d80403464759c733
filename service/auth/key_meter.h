#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace farhorizon {

/// How much each owner of keys may ask for; 0: without bound.
struct MeterBounds {
  std::int64_t requests_per_minute = 0;
  std::int64_t upload_bytes_per_hour = 0;
};

/// Counts what each owner asks for: two buckets, of requests and of bytes, that are full at first
/// and fill again evenly. An upload is counted when it has come in, whatever its size; while that
/// leaves a debt, no other is taken.
/// Threads: safe.
class KeyMeter {
 public:
  explicit KeyMeter(const MeterBounds& bounds) : bounds_(bounds) {}

  /// Counts a request; 0 where it may be answered, else the seconds after which one may.
  std::int64_t TakeRequest(const std::string& owner, bool uploads, std::int64_t now_ms);
  void TakeBytes(const std::string& owner, std::int64_t bytes, std::int64_t now_ms);

 private:
  struct Buckets {
    double requests = 0;
    double bytes = 0;
    std::int64_t filled_ms = 0;
  };
  Buckets& Filled(const std::string& owner, std::int64_t now_ms);

  const MeterBounds bounds_;
  std::mutex mutex_;
  std::map<std::string, Buckets> owners_;
};

}  // namespace farhorizon
