#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "core/exact/int128.h"

namespace farhorizon {

/// An integer of 1280 bits, two's complement, for the few numbers that outgrow 128 bits. Its size is
/// fixed, so nothing is allocated; wraps round like the machine's integers. Cost: a product some 0.2
/// microseconds.
///
/// Enough for products of two vectors at a WideDyadic (quadratic.h), 2 * (52 + 424) bits, and for
/// heights over lines through any double (witness.cpp), 1074 + 160 bits.
class Int1280 {
 public:
  Int1280() = default;
  explicit Int1280(Int128 value);

  /// The lowest bits, as a cast between the machine's integers gives them.
  explicit operator std::int64_t() const { return static_cast<std::int64_t>(words_[0]); }
  explicit operator Int128() const;
  /// Within one unit in the last place. Requires: |value| < 2^1023.
  explicit operator double() const;

  Int1280 operator-() const;
  Int1280 operator<<(int count) const;
  /// Rounds down.
  Int1280 operator>>(int count) const;
  friend Int1280 operator+(const Int1280& a, const Int1280& b);
  friend Int1280 operator-(const Int1280& a, const Int1280& b);
  friend Int1280 operator*(const Int1280& a, const Int1280& b);
  friend bool operator==(const Int1280& a, const Int1280& b) = default;
  friend std::strong_ordering operator<=>(const Int1280& a, const Int1280& b);
  friend int SignOf(const Int1280& value);

 private:
  static constexpr std::size_t kWords = 20;
  [[nodiscard]] bool IsNegative() const { return words_[kWords - 1] >> 63U != 0; }

  std::array<std::uint64_t, kWords> words_{};  // the least significant first
};

}  // namespace farhorizon
