#include "tests/support/loopback_server.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace farhorizon {

LoopbackServer::LoopbackServer() {
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
}

void LoopbackServer::Start(std::function<void(int client)> serve) {
  thread_ = std::thread([this, serve = std::move(serve)] {
    for (;;) {
      const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      if (client < 0) return;
      ++connections_;
      serve(client);
      ::close(client);
    }
  });
}

void LoopbackServer::Stop() {
  if (listener_ < 0) return;
  ::shutdown(listener_, SHUT_RDWR);
  if (thread_.joinable()) thread_.join();
  ::close(std::exchange(listener_, -1));
}

}  // namespace farhorizon
