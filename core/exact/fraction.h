#pragma once

#include "core/exact/int128.h"

namespace farhorizon {

/// A number as a quotient of integers, denominator > 0; not reduced.
struct Fraction {
  Int128 numerator = 0;
  Int128 denominator = 1;
};

/// -1, 0, 1 as a < b, a = b, a > b. Exact.
inline int Compare(const Fraction& a, const Fraction& b) {
  return CompareProducts(a.numerator, b.denominator, b.numerator, a.denominator);
}

}  // namespace farhorizon
