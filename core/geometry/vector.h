#pragma once

#include <cstdint>

#include "core/exact/int128.h"
#include "core/exact/int1280.h"

namespace farhorizon {

/// An exact vector in the plan. Everything here is made for three sizes of numbers: 64 bits for most
/// points, in which components are below 2^62; 128 bits; and wide ones for the few points of great
/// cliffs that need them.
template <typename Int>
struct BasicVector {
  Int x{};
  Int y{};

  [[nodiscard]] bool IsZero() const { return SignOf(x) == 0 && SignOf(y) == 0; }
  BasicVector operator-() const { return {-x, -y}; }
};
using ShortVector = BasicVector<std::int64_t>;
using Vector = BasicVector<Int128>;
using WideVector = BasicVector<Int1280>;

}  // namespace farhorizon
