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

/// The exact integers that stand for `values`, all of them below 2^30 in magnitude; NaN is no data.
///
/// Quantum 1 where all are whole; else the coarsest power of two that all are multiples of, with an
/// offset only where the range needs one. Where that is too fine for 30 bits: the finest power of
/// two that is not, values rounded to it (to even at a tie), `quantized` set.
/// Requires: no value is infinite, all are below 2^30 in magnitude.
/// Cost: O(n), two passes.
ScaledHeights ScaleHeights(const std::vector<double>& values);

}  // namespace farhorizon
