#include "core/io/ticks.h"

#include <cmath>
#include <cstdint>

namespace farhorizon {

double TickStep(double size, double count) {
  const double rough = size / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (rough <= factor * power) return factor * power;
  }
  return 10 * power;
}

std::vector<double> TicksWithin(double least, double most, double step) {
  std::vector<double> ticks;
  if (least > most) return ticks;
  const auto last = static_cast<std::int64_t>(std::floor(most / step));
  for (auto i = static_cast<std::int64_t>(std::ceil(least / step)); i <= last; ++i) {
    ticks.push_back(static_cast<double>(i) * step);
  }
  return ticks;
}

}  // namespace farhorizon
