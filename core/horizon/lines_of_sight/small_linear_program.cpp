// The dual simplex method for three numbers. A basis is three bounds that meet in one x; it is kept
// such that the objective, the last number, is a combination of their weights with factors >= 0, so
// that no x within the three has a greater last number. The bound that x exceeds most enters, and
// the one leaves whose factor would be the first to become negative.
#include "core/horizon/lines_of_sight/small_linear_program.h"

#include <algorithm>
#include <cmath>

namespace farhorizon {

namespace {

using Triple = std::array<double, 3>;

Triple Cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double Dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

std::array<double, 3> GreatestLast(std::span<const LinearBound> bounds,
                                   std::array<std::size_t, 3> basis) {
  // More than any case known to end takes. Any number is sound, as callers try what comes out.
  constexpr int kMostExchanges = 24;
  Triple x{};
  for (int i = 0; i < kMostExchanges; ++i) {
    const Triple& a = bounds[basis[0]].weights;
    const Triple& b = bounds[basis[1]].weights;
    const Triple& c = bounds[basis[2]].weights;
    // The columns of the inverse of the matrix with the rows a, b, c, times its determinant.
    const std::array<Triple, 3> columns = {Cross(b, c), Cross(c, a), Cross(a, b)};
    const double determinant = Dot(a, columns[0]);
    if (determinant == 0) return x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = (columns[0][k] * bounds[basis[0]].most + columns[1][k] * bounds[basis[1]].most +
              columns[2][k] * bounds[basis[2]].most) /
             determinant;
    }
    std::size_t entering = bounds.size();
    double most_beyond = 1e-12 * (1 + std::abs(x[2]));
    for (std::size_t k = 0; k < bounds.size(); ++k) {
      const double beyond = Dot(bounds[k].weights, x) - bounds[k].most;
      if (beyond > most_beyond) {
        most_beyond = beyond;
        entering = k;
      }
    }
    if (entering == bounds.size()) return x;
    std::size_t leaving = 3;
    double least = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double share = Dot(columns[k], bounds[entering].weights) / determinant;
      const double factor = std::max(columns[k][2] / determinant, 0.0);
      if (share > 1e-14 && (leaving == 3 || factor < least * share)) {
        leaving = k;
        least = factor / share;
      }
    }
    if (leaving == 3) return x;
    basis[leaving] = entering;
  }
  return x;
}

}  // namespace farhorizon
