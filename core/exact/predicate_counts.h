#pragma once

#include <cstdint>

namespace farhorizon {

/// Counts of exact decisions, by the rung that made them.
struct PredicateCounts {
  std::int64_t filtered = 0;
  std::int64_t exact = 0;
  std::int64_t tied = 0;

  [[nodiscard]] std::int64_t Sum() const { return filtered + exact + tied; }
  PredicateCounts& operator+=(const PredicateCounts& more) {
    filtered += more.filtered;
    exact += more.exact;
    tied += more.tied;
    return *this;
  }
};

}  // namespace farhorizon
