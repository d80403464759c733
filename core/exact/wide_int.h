#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "core/exact/wide.h"

namespace farhorizon {

/// An integer of 1280 bits, two's complement, for the few numbers that outgrow 128 bits. Its size is
/// fixed, so nothing is allocated; wraps round like the machine's integers. Cost: a product some 0.2
/// microseconds.
///
/// Enough for products of two vectors at a WideDyadic (quadratic.h), 2 * (52 + 424) bits, and for
/// heights over lines through any double (witness.cpp), 1074 + 160 bits.
class WideInt {
 public:
  WideInt() = default;
  explicit WideInt(Int128 value);

  /// The lowest bits, as a cast between the machine's integers gives them.
  explicit operator std::int64_t() const { return static_cast<std::int64_t>(words_[0]); }
  explicit operator Int128() const;
  /// Within one unit in the last place. Requires: |value| < 2^1023.
  explicit operator double() const;

  WideInt operator-() const;
  WideInt operator<<(int count) const;
  /// Rounds down.
  WideInt operator>>(int count) const;
  friend WideInt operator+(const WideInt& a, const WideInt& b);
  friend WideInt operator-(const WideInt& a, const WideInt& b);
  friend WideInt operator*(const WideInt& a, const WideInt& b);
  friend bool operator==(const WideInt& a, const WideInt& b) = default;
  friend std::strong_ordering operator<=>(const WideInt& a, const WideInt& b);
  friend int SignOf(const WideInt& value);

 private:
  static constexpr std::size_t kWords = 20;
  [[nodiscard]] bool IsNegative() const { return words_[kWords - 1] >> 63U != 0; }

  std::array<std::uint64_t, kWords> words_{};  // the least significant first
};

}  // namespace farhorizon
