#include "service/cli/notify.h"

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "core/io/unique_fd.h"

namespace farhorizon {

namespace {

// NOLINTNEXTLINE(concurrency-mt-unsafe): none is ever set
std::string_view Variable(const char* name) {
  const char* value = ::secure_getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

}  // namespace

void NotifyManager(std::string_view state) {
  const std::string_view path = Variable("NOTIFY_SOCKET");
  struct sockaddr_un address {};
  if (path.size() < 2 || path.size() >= sizeof(address.sun_path)) return;
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.data(), path.size());
  if (path[0] == '@') address.sun_path[0] = '\0';  // a name that is in no folder
  const UniqueFd socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket) return;
  const auto size = static_cast<socklen_t>(offsetof(struct sockaddr_un, sun_path) + path.size());
  // A manager that does not listen is no reason to stop.
  [[maybe_unused]] const ssize_t sent =
      ::sendto(socket.get(), state.data(), state.size(), MSG_NOSIGNAL,
               reinterpret_cast<const struct sockaddr*>(&address), size);
}

std::optional<std::chrono::milliseconds> WatchdogInterval() {
  const std::string_view text = Variable("WATCHDOG_USEC");
  std::int64_t microseconds = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), microseconds);
  if (failure != std::errc() || end != text.data() + text.size() || microseconds <= 0) {
    return std::nullopt;
  }
  return std::chrono::milliseconds(microseconds / 1000);
}

}  // namespace farhorizon
