#include "core/geometry/finer_heights.h"

#include <algorithm>
#include <bit>

namespace farhorizon {

namespace {

// Heights of an occluder set are below this in size.
constexpr int kLimitBits = 30;
constexpr std::int64_t kLimit = std::int64_t{1} << kLimitBits;

}  // namespace

FinerHeights FinerHeights::Centred(const HeightRange& range) {
  // Any value is sound; a thousandth of a quantum is as fine as anybody asks for.
  constexpr int kFinestBits = 10;
  const std::int64_t relief = std::int64_t{range.greatest} - range.least;
  FinerHeights heights;
  heights.zero = static_cast<std::int32_t>(range.least + relief / 2);
  // An edge lowered by more than the relief is occluded everywhere, so none is lowered further.
  const std::int64_t reach = relief * 2 + 2;
  while (heights.bits < kFinestBits && reach << (heights.bits + 1) < kLimit) ++heights.bits;
  const std::int64_t half = (relief / 2 + 1) << heights.bits;
  heights.most_steps = static_cast<std::int32_t>(std::max<std::int64_t>(kLimit - 1 - half, 0));
  return heights;
}

FinerHeights FinerHeights::FromLeast(const HeightRange& range, double tolerance) {
  const std::int64_t relief = std::max<std::int64_t>(std::int64_t{range.greatest} - range.least, 1);
  const int relief_bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(relief)));
  FinerHeights heights;
  heights.zero = range.least;
  // A DEM's heights are below 2^30 in size, so that relief < 2^31, and its bits have room in 31.
  constexpr int kSignedBits = 31;
  heights.bits = std::clamp(static_cast<int>(std::ceil(-std::log2(tolerance))), 0,
                            std::max(kSignedBits - relief_bits, 0));
  heights.most_steps = static_cast<std::int32_t>(relief << heights.bits);
  return heights;
}

std::int32_t FinerHeights::Steps(double quanta) const {
  const double steps = std::floor(std::ldexp(quanta, bits));
  return static_cast<std::int32_t>(std::clamp(steps, 0.0, static_cast<double>(most_steps)));
}

}  // namespace farhorizon
