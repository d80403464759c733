#include "tests/support/cutting_proxy.h"

#include <algorithm>
#include <array>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include "tests/support/service_process.h"

namespace farhorizon {

CuttingProxy::CuttingProxy(std::uint16_t service, std::function<std::size_t(int)> most)
    : service_(service), most_(std::move(most)) {
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  struct sockaddr_in address {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* const any = reinterpret_cast<struct sockaddr*>(&address);
  socklen_t size = sizeof(address);
  if (::bind(listener_, any, size) == 0 && ::listen(listener_, 64) == 0 &&
      ::getsockname(listener_, any, &size) == 0) {
    port_ = ntohs(address.sin_port);
  }
  thread_ = std::thread([this] { Run(); });
}

CuttingProxy::~CuttingProxy() {
  ::shutdown(listener_, SHUT_RDWR);
  thread_.join();
  ::close(listener_);
}

void CuttingProxy::Run() {
  for (;;) {
    const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (client < 0) return;
    Pass(client, most_(connections_++));
    ::close(client);
  }
}

void CuttingProxy::Pass(int client, std::size_t most) const {
  const int service = Connect(service_);
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

}  // namespace farhorizon
