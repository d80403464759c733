#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>

namespace farhorizon {

/// A server on a free port of loopback that gives each connection to `serve`, one at a time, and
/// closes it then. Its thread begins with Start, and ends with Stop or the object.
class LoopbackServer {
 public:
  LoopbackServer();
  ~LoopbackServer() { Stop(); }
  LoopbackServer(const LoopbackServer&) = delete;
  LoopbackServer& operator=(const LoopbackServer&) = delete;

  void Start(std::function<void(int client)> serve);
  void Stop();
  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] int connections() const { return connections_; }

 private:
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::atomic<int> connections_{0};
  std::thread thread_;
};

}  // namespace farhorizon
