#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace farhorizon {

/// Tells the service manager a state, such as "READY=1", as sd_notify(3) of systemd does. Does
/// nothing where none asks: NOTIFY_SOCKET is not set.
void NotifyManager(std::string_view state);

/// How often the service manager wants to hear "WATCHDOG=1"; nullopt where it does not.
std::optional<std::chrono::milliseconds> WatchdogInterval();

}  // namespace farhorizon
