#include "core/exact/int1280.h"

#include <cmath>

namespace farhorizon {
namespace {

__extension__ typedef unsigned __int128 Uint128;  // NOLINT(modernize-use-using)

constexpr std::uint64_t kOnes = ~std::uint64_t{0};
constexpr std::size_t kWordBits = 64;

}  // namespace

Int1280::Int1280(Int128 value) {
  words_.fill(value < 0 ? kOnes : 0);
  words_[0] = static_cast<std::uint64_t>(value);
  words_[1] = static_cast<std::uint64_t>(value >> kWordBits);
}

Int1280::operator Int128() const {
  return static_cast<Int128>((Uint128{words_[1]} << kWordBits) | words_[0]);
}

Int1280::operator double() const {
  const Int1280 magnitude = IsNegative() ? -*this : *this;
  std::size_t top = kWords - 1;
  while (top > 1 && magnitude.words_[top] == 0) --top;
  // The two leading words hold 65 bits at least, or the whole number.
  const double leading =
      std::ldexp(static_cast<double>(magnitude.words_[top]), static_cast<int>(kWordBits)) +
      static_cast<double>(magnitude.words_[top - 1]);
  const double size = std::ldexp(leading, static_cast<int>((top - 1) * kWordBits));
  return IsNegative() ? -size : size;
}

Int1280 Int1280::operator-() const { return Int1280() - *this; }

Int1280 Int1280::operator<<(int count) const {
  const std::size_t words = static_cast<std::size_t>(count) / kWordBits;
  const std::size_t bits = static_cast<std::size_t>(count) % kWordBits;
  Int1280 result;
  for (std::size_t i = kWords; i-- > words;) {
    result.words_[i] = words_[i - words] << bits;
    if (bits > 0 && i > words) result.words_[i] |= words_[i - words - 1] >> (kWordBits - bits);
  }
  return result;
}

Int1280 Int1280::operator>>(int count) const {
  const std::size_t words = static_cast<std::size_t>(count) / kWordBits;
  const std::size_t bits = static_cast<std::size_t>(count) % kWordBits;
  const std::uint64_t beyond = IsNegative() ? kOnes : 0;
  const auto word = [&](std::size_t i) { return i < kWords ? words_[i] : beyond; };
  Int1280 result;
  for (std::size_t i = 0; i < kWords; ++i) {
    result.words_[i] = word(i + words) >> bits;
    if (bits > 0) result.words_[i] |= word(i + words + 1) << (kWordBits - bits);
  }
  return result;
}

Int1280 operator+(const Int1280& a, const Int1280& b) {
  Int1280 sum;
  Uint128 carry = 0;
  for (std::size_t i = 0; i < Int1280::kWords; ++i) {
    carry += Uint128{a.words_[i]} + b.words_[i];
    sum.words_[i] = static_cast<std::uint64_t>(carry);
    carry >>= kWordBits;
  }
  return sum;
}

Int1280 operator-(const Int1280& a, const Int1280& b) {
  Int1280 difference;
  Uint128 carry = 1;  // a - b = a + ~b + 1
  for (std::size_t i = 0; i < Int1280::kWords; ++i) {
    carry += Uint128{a.words_[i]} + ~b.words_[i];
    difference.words_[i] = static_cast<std::uint64_t>(carry);
    carry >>= kWordBits;
  }
  return difference;
}

Int1280 operator*(const Int1280& a, const Int1280& b) {
  Int1280 product;
  for (std::size_t i = 0; i < Int1280::kWords; ++i) {
    Uint128 carry = 0;
    for (std::size_t j = 0; i + j < Int1280::kWords; ++j) {
      carry += Uint128{a.words_[i]} * b.words_[j] + product.words_[i + j];
      product.words_[i + j] = static_cast<std::uint64_t>(carry);
      carry >>= kWordBits;
    }
  }
  return product;
}

std::strong_ordering operator<=>(const Int1280& a, const Int1280& b) {
  if (a.IsNegative() != b.IsNegative()) {
    return a.IsNegative() ? std::strong_ordering::less : std::strong_ordering::greater;
  }
  for (std::size_t i = Int1280::kWords; i-- > 0;) {
    if (a.words_[i] != b.words_[i]) return a.words_[i] <=> b.words_[i];
  }
  return std::strong_ordering::equal;
}

int SignOf(const Int1280& value) {
  if (value.IsNegative()) return -1;
  return value == Int1280() ? 0 : 1;
}

}  // namespace farhorizon
