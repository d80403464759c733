#include "service/random.h"

#include <sys/random.h>

#include "core/base/result.h"

namespace farhorizon {

std::array<unsigned char, 16> RandomBytes() {
  std::array<unsigned char, 16> bytes{};
  Check(::getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()),
        "the kernel gives 16 random bytes");
  return bytes;
}

}  // namespace farhorizon
