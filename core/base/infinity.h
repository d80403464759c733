#pragma once

#include <limits>

namespace farhorizon {

/// Greater than every number: where a least value has not been met yet.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace farhorizon
