#pragma once

namespace farhorizon {

/// The greatest integer that is not above a / b. Int: a signed integer of the language, or Int128.
/// Requires: b is not 0, and a / b fits.
template <typename Int>
constexpr Int FloorDivide(Int a, Int b) {
  const Int quotient = a / b;
  return a % b != 0 && (a < 0) != (b < 0) ? quotient - 1 : quotient;
}

}  // namespace farhorizon
