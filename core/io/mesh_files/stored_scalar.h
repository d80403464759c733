#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace farhorizon {

/// The types of numbers in binary mesh files.
enum class ScalarType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

constexpr std::size_t BytesOf(ScalarType type) {
  constexpr std::array<std::size_t, 8> kBytes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

enum class ByteOrder { kLittle, kBig };

namespace stored_scalar_detail {

template <typename T>
T Load(const std::uint8_t* at, ByteOrder order) {
  std::array<std::uint8_t, sizeof(T)> bytes;
  const bool native = (order == ByteOrder::kLittle) == (std::endian::native == std::endian::little);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = at[native ? i : bytes.size() - 1 - i];
  }
  return std::bit_cast<T>(bytes);
}

}  // namespace stored_scalar_detail

/// The number that is stored at `at`. Requires: BytesOf(type) bytes are there.
inline double ScalarAt(const std::uint8_t* at, ScalarType type,
                       ByteOrder order = ByteOrder::kLittle) {
  using stored_scalar_detail::Load;
  switch (type) {
    case ScalarType::kInt8:
      return Load<std::int8_t>(at, order);
    case ScalarType::kUint8:
      return Load<std::uint8_t>(at, order);
    case ScalarType::kInt16:
      return Load<std::int16_t>(at, order);
    case ScalarType::kUint16:
      return Load<std::uint16_t>(at, order);
    case ScalarType::kInt32:
      return Load<std::int32_t>(at, order);
    case ScalarType::kUint32:
      return Load<std::uint32_t>(at, order);
    case ScalarType::kFloat:
      return double{Load<float>(at, order)};
    case ScalarType::kDouble:
      return Load<double>(at, order);
  }
  return 0;
}

/// A whole number of 32 bits, little-endian. Requires: four bytes are there.
inline std::uint32_t Uint32At(const std::uint8_t* at) {
  return stored_scalar_detail::Load<std::uint32_t>(at, ByteOrder::kLittle);
}

}  // namespace farhorizon
