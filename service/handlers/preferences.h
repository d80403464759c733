#pragma once

#include <cstdint>
#include <optional>

#include "service/handlers/http_message.h"

namespace farhorizon {

/// For how long a client may wait for one answer.
inline constexpr std::int64_t kMostWaitSeconds = 60;

/// What a client would like of the answer [RFC 7240].
struct Preferences {
  bool respond_async = false;
  std::optional<std::int64_t> wait_seconds;  ///< for which it waits, at most
};

/// The preferences in the fields Prefer of a request. The first of two alike counts; others, and
/// what cannot be read, are passed over.
Preferences PreferencesOf(const HttpRequest& request);

}  // namespace farhorizon
