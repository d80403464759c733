#include "core/geometry/finer_heights.h"

#include <algorithm>

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
  const double relief = std::max(1.0, static_cast<double>(range.greatest) - range.least);
  const int relief_bits = std::ilogb(relief) + 1;
  FinerHeights heights;
  heights.zero = range.least;
  // Scaled heights are in [0, 2^29], and nearbyint may reach its end.
  heights.bits =
      std::min(static_cast<int>(std::ceil(-std::log2(tolerance))), kLimitBits - 1 - relief_bits);
  heights.most_steps = static_cast<std::int32_t>(kLimit - 1);
  return heights;
}

std::int32_t FinerHeights::Steps(double quanta) const {
  const double steps = std::floor(std::ldexp(quanta, bits));
  return static_cast<std::int32_t>(std::clamp(steps, 0.0, static_cast<double>(most_steps)));
}

}  // namespace farhorizon
