#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/geometry/finer_heights.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// The heights of all posts with data. Requires: there is one.
inline HeightRange HeightRangeOf(const Dem& dem) {
  HeightRange range{std::numeric_limits<std::int32_t>::max(),
                    std::numeric_limits<std::int32_t>::min()};
  for (const std::int32_t height : dem.heights) {
    if (height == kNoHeight) continue;
    range.least = std::min(range.least, height);
    range.greatest = std::max(range.greatest, height);
  }
  return range;
}

}  // namespace farhorizon
