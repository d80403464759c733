#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace farhorizon {

/// A set of directions of sight, to be tested by one AND: bit i stands for the azimuths from
/// i * 180 / 64 to (i + 1) * 180 / 64 degrees clockwise from true north, and for their opposites.
using AzimuthMask = std::uint64_t;
inline constexpr int kAzimuthBins = 64;

/// The bits of all azimuths within [from, to], degrees; any from and to with from <= to.
AzimuthMask MaskOfInterval(double from_deg, double to_deg);

/// The bits of all of the intervals.
AzimuthMask MaskOf(const std::vector<std::array<double, 2>>& azimuths);

/// 16 lower-case hexadecimal digits, bit 63 first.
std::string MaskText(AzimuthMask mask);

}  // namespace farhorizon
