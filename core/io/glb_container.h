#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// The chunks of a glTF binary: views into its bytes. bin is empty where there is none.
struct GlbChunks {
  std::span<const std::uint8_t> json;
  std::span<const std::uint8_t> bin;
};

/// A glTF 2.0 binary of a JSON text and the bytes of its buffer. Both chunks are padded so that
/// their content ends at a multiple of `alignment`, 4 or 8, counted from the file's start; so the
/// buffer begins at one.
std::vector<std::uint8_t> JoinGlb(std::string_view json, std::span<const std::uint8_t> buffer,
                                  std::size_t alignment = 4);

/// Whether `bytes` begin as a glTF binary of any version does.
bool IsGlb(std::span<const std::uint8_t> bytes);

/// Splits a glTF 2.0 binary. Chunks after the first two, and bytes after the length that the header
/// names, are passed over.
/// Errors: kUnsupportedData, kind "bad-glb", with the cause.
Result<GlbChunks> SplitGlb(std::span<const std::uint8_t> bytes);

}  // namespace farhorizon
