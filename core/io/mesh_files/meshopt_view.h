#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// What EXT_meshopt_compression says of a buffer view.
struct MeshoptView {
  std::uint64_t stride = 0;  ///< bytes of an element
  std::uint64_t count = 0;
  std::string_view mode;    ///< ATTRIBUTES, TRIANGLES or INDICES
  std::string_view filter;  ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// Decompresses a buffer view [EXT_meshopt_compression].
/// Requires: stride * count bytes may be allocated.
/// Errors: "bad-mesh-file".
Result<std::vector<std::uint8_t>> DecodeMeshopt(std::span<const std::uint8_t> bytes,
                                                const MeshoptView& view);

}  // namespace farhorizon
