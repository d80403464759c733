// One pass finds the range of the values and the lowest bit that any of them has, which decide the
// quantum; a second one scales. Powers of two scale doubles exactly.
#include "core/io/dem/values/height_quantum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/base/result.h"
#include "core/terrain/dem.h"

namespace farhorizon {

namespace {

constexpr std::int64_t kLimit = std::int64_t{1} << 30;  // Dem's bound on heights
constexpr int kMantissaBits = 53;

// The greatest e with value a multiple of 2^e; value is finite and not 0.
int LowestBit(double value) {
  int exponent = 0;
  const double fraction = std::frexp(std::abs(value), &exponent);
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, kMantissaBits));
  return exponent - kMantissaBits + std::countr_zero(mantissa);
}

// The properties of the values that decide the quantum.
struct Extent {
  double least = 0;
  double greatest = 0;
  int lowest_bit = 0;  // all values are multiples of 2^lowest_bit; at most 0
  bool any = false;
};

Extent Measure(const std::vector<double>& values) {
  Extent extent;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    extent.least = extent.any ? std::min(extent.least, value) : value;
    extent.greatest = extent.any ? std::max(extent.greatest, value) : value;
    extent.any = true;
    // Whole numbers, the common case, are multiples of 1 whatever their bits.
    if (value != std::trunc(value)) {
      extent.lowest_bit = std::min(extent.lowest_bit, LowestBit(value));
    }
  }
  Check(std::abs(extent.least) < kLimit && std::abs(extent.greatest) < kLimit,
        "height beyond 2^30");
  return extent;
}

struct Choice {
  int exponent = 0;         // quantum = 2^exponent
  std::int64_t offset = 0;  // in quanta
  bool quantized = false;
};

Choice ChooseQuantum(const Extent& extent) {
  const double magnitude = std::max(std::abs(extent.least), std::abs(extent.greatest));
  const int exponent = extent.lowest_bit;
  const auto in_quanta = [](double value, int e) { return std::ldexp(value, -e); };
  if (in_quanta(magnitude, exponent) < static_cast<double>(kLimit)) return {exponent, 0, false};
  if (in_quanta(magnitude, exponent) <= std::ldexp(1.0, kMantissaBits)) {
    const auto least = static_cast<std::int64_t>(in_quanta(extent.least, exponent));
    const auto greatest = static_cast<std::int64_t>(in_quanta(extent.greatest, exponent));
    if (greatest - least < 2 * kLimit - 2) {
      return {exponent, least + (greatest - least) / 2, false};
    }
  }
  // magnitude = f * 2^k with f in [1/2, 1): at 2^(k - 30) it stays below 2^30 unless it rounds up.
  int k = 0;
  std::frexp(magnitude, &k);
  int coarser = k - 30;
  if (std::nearbyint(in_quanta(magnitude, coarser)) >= static_cast<double>(kLimit)) ++coarser;
  return {coarser, 0, true};
}

}  // namespace

ScaledHeights ScaleHeights(const std::vector<double>& values) {
  const Choice choice = ChooseQuantum(Measure(values));
  ScaledHeights scaled;
  scaled.quantum = std::ldexp(1.0, choice.exponent);
  scaled.offset = std::ldexp(static_cast<double>(choice.offset), choice.exponent);
  scaled.quantized = choice.quantized;
  scaled.heights.reserve(values.size());
  for (const double value : values) {
    if (std::isnan(value)) {
      scaled.heights.push_back(kNoHeight);
      continue;
    }
    const auto quanta =
        static_cast<std::int64_t>(std::nearbyint(std::ldexp(value, -choice.exponent)));
    scaled.heights.push_back(static_cast<std::int32_t>(quanta - choice.offset));
  }
  return scaled;
}

}  // namespace farhorizon
