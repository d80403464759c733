#include "core/pipeline/verify/random_line.h"

#include <cstdint>

namespace farhorizon {

PlanLine RandomLine(const Dem& dem, std::mt19937_64& random) {
  // By remainder instead of a distribution, whose numbers differ between standard libraries.
  const auto draw = [&random](std::int32_t below) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(below));
  };
  PlanLine line{draw(2 * dem.columns), draw(2 * dem.rows), draw(2001) - 1000, draw(2001) - 1000};
  if (line.dc == 0 && line.dr == 0) line.dc = 1;
  return line;
}

}  // namespace farhorizon
