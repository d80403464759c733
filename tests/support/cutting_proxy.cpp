#include "tests/support/cutting_proxy.h"

#include <algorithm>
#include <array>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include "tests/support/service_process.h"

namespace farhorizon {

namespace {

void Pass(int client, std::uint16_t port, std::size_t most) {
  const int service = Connect(port);
  std::array<struct pollfd, 2> both = {{{client, POLLIN, 0}, {service, POLLIN, 0}}};
  std::array<char, 4096> bytes{};
  while (service >= 0 && ::poll(both.data(), both.size(), 20'000) > 0) {
    const bool answer = both[1].revents != 0;
    ssize_t size = ::recv(answer ? service : client, bytes.data(), bytes.size(), 0);
    if (size <= 0) break;
    if (answer) {
      size = static_cast<ssize_t>(std::min(static_cast<std::size_t>(size), most));
      most -= static_cast<std::size_t>(size);
    }
    if (::send(answer ? client : service, bytes.data(), static_cast<std::size_t>(size),
               MSG_NOSIGNAL) != size ||
        most == 0) {
      break;
    }
  }
  if (service >= 0) ::close(service);
}

}  // namespace

CuttingProxy::CuttingProxy(std::uint16_t service, std::function<std::size_t(int connection)> most) {
  server_.Start([this, service, most = std::move(most)](int client) {
    Pass(client, service, most(connections() - 1));
  });
}

}  // namespace farhorizon
