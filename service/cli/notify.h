#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace farhorizon {

/// Tells the service manager a state, such as "READY=1" [sd_notify]. Does nothing where none asks:
/// NOTIFY_SOCKET is not set.
void NotifyManager(std::string_view state);

/// How often the service manager wants to hear "WATCHDOG=1"; nullopt where it does not.
std::optional<std::chrono::milliseconds> WatchdogInterval();

}  // namespace farhorizon
