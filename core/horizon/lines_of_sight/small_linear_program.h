#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace farhorizon {

/// weights . x <= most.
struct LinearBound {
  std::array<double, 3> weights = {};
  double most = 0;
};

/// The x of three numbers whose last is greatest under all bounds, in doubles: by the dual simplex
/// method.
///
/// basis: three of the bounds that bound it already: combined with factors that are not negative
///   they bound the last number alone.
/// Requires: some x is within all bounds. Cost: O(bounds) for each exchange, of which there are
/// few; after too many, as rounding may lead to, x of the last basis.
std::array<double, 3> GreatestLast(std::span<const LinearBound> bounds,
                                   std::array<std::size_t, 3> basis);

}  // namespace farhorizon
