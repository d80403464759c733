#pragma once

#include <cstdint>

namespace farhorizon {

/// Counts of exact comparisons by the arithmetic that decided them.
struct PredicateCounts {
  std::int64_t filtered = 0;  ///< floating point, with an error bound
  std::int64_t exact = 0;     ///< integers: the two sides differ
  std::int64_t tied = 0;      ///< integers: the two sides are equal

  [[nodiscard]] std::int64_t Sum() const { return filtered + exact + tied; }
  PredicateCounts& operator+=(const PredicateCounts& more) {
    filtered += more.filtered;
    exact += more.exact;
    tied += more.tied;
    return *this;
  }
};

}  // namespace farhorizon
