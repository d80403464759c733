#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/io/line_chains.h"

namespace farhorizon {

/// What a file of WriteHorizonGlb holds, for verification. in_box: whether all points are within
/// the bounds that the accessor claims.
struct HorizonGlbContents {
  std::vector<LineChain> chains;
  std::array<double, 16> matrix = {};
  bool in_box = false;
};

/// Takes only what WriteHorizonGlb makes, and checks each offset and each index.
/// Errors: kUnsupportedData, kind "bad-glb", with the cause.
Result<HorizonGlbContents> ReadHorizonGlb(const std::vector<std::uint8_t>& bytes);

}  // namespace farhorizon
