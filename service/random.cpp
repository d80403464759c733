#include "service/random.h"

#include <algorithm>
#include <sys/random.h>

#include "core/base/result.h"

namespace farhorizon {

std::array<unsigned char, 16> RandomBytes() {
  std::array<unsigned char, 16> bytes{};
  Check(::getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()),
        "the kernel gives 16 random bytes");
  return bytes;
}

std::chrono::milliseconds RandomDelay(std::chrono::milliseconds first,
                                      std::chrono::milliseconds longest, std::int64_t doublings) {
  const auto most = std::min(longest, first * (1 << std::min<std::int64_t>(doublings, 10)));
  const auto bytes = RandomBytes();
  return most * (bytes[0] + 256 * bytes[1]) / 65536;
}

}  // namespace farhorizon
