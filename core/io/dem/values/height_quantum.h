#pragma once

#include <cstdint>
#include <vector>

namespace farhorizon {

/// Heights as integers: value = offset + heights[i] * quantum, kNoHeight for NaN.
struct ScaledHeights {
  std::vector<std::int32_t> heights;
  double quantum = 1;  ///< a power of two, at most 1
  double offset = 0;   ///< a multiple of the quantum
  bool quantized = false;
};

/// Chooses a quantum and scales `values` to integers below 2^30 in magnitude; NaN is no data.
///
/// The quantum is 1 where all values are whole; otherwise the coarsest power of two of which all
/// are multiples, with an offset where the range needs one. Where that is too fine for 30 bits, the
/// quantum is the finest power of two that is not, values are rounded to it (to even at a tie) and
/// `quantized` is set.
/// Requires: no value is infinite, all are below 2^30 in magnitude.
/// Cost: O(n), two passes.
ScaledHeights ScaleHeights(const std::vector<double>& values);

}  // namespace farhorizon
