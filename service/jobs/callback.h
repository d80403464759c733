#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace farhorizon {

/// What of a job a subscriber is called for.
enum class CallbackEvent { kInProgress, kSuccess, kFailure };
inline constexpr std::array kCallbackEventNames = {"in-progress", "success", "failure"};
inline const char* NameOf(CallbackEvent event) {
  return kCallbackEventNames.at(static_cast<std::size_t>(event));
}

/// Where a job's client wants to be called, by the names of OGC API - Processes; empty: not.
struct Subscriber {
  std::string success_uri;
  std::string in_progress_uri;
  std::string failed_uri;

  friend bool operator==(const Subscriber&, const Subscriber&) = default;
};

/// A call that is to be made, claimed for the time of a lease.
struct DueCallback {
  std::string job_id;
  CallbackEvent event = CallbackEvent::kInProgress;
  std::string url;
  std::int64_t attempt = 0;          ///< the number of this one, from 1 on; identifies the claim
  std::chrono::milliseconds age{0};  ///< since there was something to tell, by the store's clock
};

/// How the calls of an event have ended.
enum class CallbackEnd { kDelivered, kGivenUp };

}  // namespace farhorizon
