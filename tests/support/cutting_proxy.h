#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "tests/support/loopback_server.h"

namespace farhorizon {

/// A proxy on loopback that breaks connections: of the n-th, counted from 0, it passes on no more
/// than most(n) bytes of the answers. For one connection at a time.
class CuttingProxy {
 public:
  CuttingProxy(std::uint16_t service, std::function<std::size_t(int connection)> most);

  [[nodiscard]] std::uint16_t port() const { return server_.port(); }
  [[nodiscard]] int connections() const { return server_.connections(); }

 private:
  LoopbackServer server_;
};

}  // namespace farhorizon
