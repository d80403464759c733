#include "core/io/azimuth_mask.h"

#include <cmath>

namespace farhorizon {

AzimuthMask MaskOfInterval(double from_deg, double to_deg) {
  constexpr double kBin = 180.0 / kAzimuthBins;
  const auto first = static_cast<std::int64_t>(std::floor(from_deg / kBin));
  const auto last = static_cast<std::int64_t>(std::floor(to_deg / kBin));
  if (last - first >= kAzimuthBins - 1) return ~AzimuthMask{0};
  AzimuthMask mask = 0;
  for (std::int64_t i = first; i <= last; ++i) {
    const std::int64_t bin = (i % kAzimuthBins + kAzimuthBins) % kAzimuthBins;
    mask |= AzimuthMask{1} << static_cast<unsigned>(bin);
  }
  return mask;
}

AzimuthMask MaskOf(const std::vector<std::array<double, 2>>& azimuths) {
  AzimuthMask mask = 0;
  for (const auto& [from, to] : azimuths) mask |= MaskOfInterval(from, to);
  return mask;
}

std::string MaskText(AzimuthMask mask) {
  std::string text;
  for (int shift = kAzimuthBins - 4; shift >= 0; shift -= 4) {
    text += "0123456789abcdef"[mask >> static_cast<unsigned>(shift) & 15U];
  }
  return text;
}

}  // namespace farhorizon
