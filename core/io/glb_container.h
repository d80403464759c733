#pragma once

#include <cstdint>
#include <span>

#include "core/base/result.h"

namespace farhorizon {

/// The chunks of a glTF binary: views into its bytes. bin is empty where there is none.
struct GlbChunks {
  std::span<const std::uint8_t> json;
  std::span<const std::uint8_t> bin;
};

/// Whether `bytes` begin as a glTF binary of any version does.
bool IsGlb(std::span<const std::uint8_t> bytes);

/// Splits a glTF 2.0 binary. Chunks after the first two, and bytes after the length that the header
/// names, are passed over.
/// Errors: kUnsupportedData, kind "bad-glb", with the cause.
Result<GlbChunks> SplitGlb(std::span<const std::uint8_t> bytes);

}  // namespace farhorizon
