#include "core/exact/int128.h"

namespace farhorizon {

namespace {

__extension__ typedef unsigned __int128 Uint128;  // NOLINT(modernize-use-using)

// A product's magnitude, low half and high half, and its sign.
struct Product {
  Uint128 low;
  Uint128 high;
  int sign;
};

// By halves of 64 bits: x y = x1 y1 2^128 + (x1 y0 + x0 y1) 2^64 + x0 y0. Requires: neither is
// -2^127.
Product Multiply(Int128 a, Int128 b) {
  const Uint128 x = a < 0 ? -static_cast<Uint128>(a) : static_cast<Uint128>(a);
  const Uint128 y = b < 0 ? -static_cast<Uint128>(b) : static_cast<Uint128>(b);
  const Uint128 mask = ~std::uint64_t{0};
  const Uint128 x0 = x & mask;
  const Uint128 x1 = x >> 64U;
  const Uint128 y0 = y & mask;
  const Uint128 y1 = y >> 64U;
  const Uint128 low = x0 * y0;
  const Uint128 cross = x1 * y0 + (low >> 64U);  // x1 <= 2^63: no overflow
  const Uint128 middle = x0 * y1 + (cross & mask);
  return {(middle << 64U) | (low & mask), x1 * y1 + (cross >> 64U) + (middle >> 64U),
          SignOf(a) * SignOf(b)};
}

int CompareMagnitudes(const Product& p, const Product& q) {
  if (p.high != q.high) return p.high > q.high ? 1 : -1;
  if (p.low != q.low) return p.low > q.low ? 1 : -1;
  return 0;
}

}  // namespace

int CompareProducts(Int128 a, Int128 b, Int128 c, Int128 d) {
  const Product p = Multiply(a, b);
  const Product q = Multiply(c, d);
  if (p.sign != q.sign) return p.sign > q.sign ? 1 : -1;
  return p.sign * CompareMagnitudes(p, q);
}

}  // namespace farhorizon
