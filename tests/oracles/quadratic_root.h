#pragma once

#include <cstdint>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

namespace farhorizon::oracle {

/// Integers of the oracle: far more bits than any of its predicates needs, and overflow throws.
using Wide = boost::multiprecision::checked_int1024_t;

/// A polynomial c0 + c1 t + c2 t^2 with integer coefficients.
struct Quadratic {
  Wide c0;
  Wide c1;
  Wide c2;
};

/// A vector of the plan that moves linearly: (x0 + x1 t, y0 + y1 t).
struct MovingVector {
  Wide x0;
  Wide y0;
  Wide x1;
  Wide y1;
};

/// The cross product of two moving vectors, as a polynomial of t.
Quadratic Cross(const MovingVector& v, const MovingVector& w);

/// The real number (p + s sqrt(d)) / q. q > 0, d >= 0, s in {-1, 0, 1}.
class QuadraticNumber {
 public:
  static QuadraticNumber Rational(const Wide& numerator, const Wide& denominator);
  static QuadraticNumber Dyadic(const Wide& numerator, int exponent) {
    return Rational(numerator, Wide(1) << static_cast<unsigned>(exponent));
  }

  /// -1, 0, 1 as a < b, a = b, a > b. Exact.
  friend int Compare(const QuadraticNumber& a, const QuadraticNumber& b);
  friend bool operator<(const QuadraticNumber& a, const QuadraticNumber& b) {
    return Compare(a, b) < 0;
  }

  /// The real roots of `f` strictly between 0 and 1; none where f is zero everywhere.
  friend std::vector<QuadraticNumber> RootsInside(const Quadratic& f);

 private:
  QuadraticNumber(Wide p, Wide q, Wide d, int s);

  Wide p_;
  Wide q_;
  Wide d_;
  int s_;
  long double nearly_;  ///< for numbers in [0, 1]: wrong by less than kNearlyError
};

std::vector<QuadraticNumber> RootsInside(const Quadratic& f);

/// A number numerator / 2^exponent.
struct DyadicNumber {
  Wide numerator;
  int exponent = 0;
};

/// The dyadic number with the fewest bits strictly between two numbers.
/// Requires: 0 <= low < high <= 1.
DyadicNumber SimplestBetween(const QuadraticNumber& low, const QuadraticNumber& high);

}  // namespace farhorizon::oracle
