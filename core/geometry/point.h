#pragma once

#include <compare>
#include <cstdint>

namespace farhorizon {

/// A post in the plan.
struct Point2i {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend auto operator<=>(const Point2i&, const Point2i&) = default;
};

/// A post as the exact predicates see it: column, row, height in quanta.
struct Point3i {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  friend bool operator==(const Point3i&, const Point3i&) = default;
};

}  // namespace farhorizon
