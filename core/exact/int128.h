#pragma once

#include <cstdint>

namespace farhorizon {

/// A 128-bit integer: it holds sums of a few products of two 62-bit numbers.
__extension__ typedef __int128 Int128;  // NOLINT(modernize-use-using): __extension__ needs typedef

/// -1, 0 or 1.
constexpr int SignOf(Int128 value) {
  return static_cast<int>(value > 0) - static_cast<int>(value < 0);
}

/// The sign of a * b - c * d, exactly, for all 128-bit operands except -2^127.
int CompareProducts(Int128 a, Int128 b, Int128 c, Int128 d);

}  // namespace farhorizon
