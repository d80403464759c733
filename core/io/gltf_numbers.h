#pragma once

#include <cstddef>

namespace farhorizon::gltf {

// Numbers of the glTF 2.0 specification (ISO/IEC 12113:2022).

// Sizes in a binary: of its header, and of the header of each chunk.
inline constexpr std::size_t kHeaderBytes = 12;
inline constexpr std::size_t kChunkHeaderBytes = 8;

// Component types of accessors.
inline constexpr int kByte = 5120;
inline constexpr int kUnsignedByte = 5121;
inline constexpr int kShort = 5122;
inline constexpr int kUnsignedShort = 5123;
inline constexpr int kUnsignedInt = 5125;
inline constexpr int kFloat = 5126;

// Targets of buffer views.
inline constexpr int kArrayBuffer = 34962;
inline constexpr int kElementArrayBuffer = 34963;

// Modes of primitives.
inline constexpr int kLines = 1;
inline constexpr int kTriangles = 4;

}  // namespace farhorizon::gltf
