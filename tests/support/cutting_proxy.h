#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>

namespace farhorizon {

/// A proxy on loopback that breaks connections: of the n-th, counted from 0, it passes on no more
/// than most(n) bytes of the answers. For one connection at a time.
class CuttingProxy {
 public:
  CuttingProxy(std::uint16_t service, std::function<std::size_t(int connection)> most);
  ~CuttingProxy();
  CuttingProxy(const CuttingProxy&) = delete;
  CuttingProxy& operator=(const CuttingProxy&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] int connections() const { return connections_; }

 private:
  void Run();
  void Pass(int client, std::size_t most) const;

  std::uint16_t service_;
  std::function<std::size_t(int)> most_;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::atomic<int> connections_{0};
  std::thread thread_;
};

}  // namespace farhorizon
