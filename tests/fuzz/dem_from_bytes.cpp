#include "tests/fuzz/dem_from_bytes.h"

#include <algorithm>
#include <array>
#include <vector>

namespace farhorizon {
namespace {

constexpr std::int32_t kLeastSide = 2;
constexpr std::int32_t kSides = 8;  // 2 to 9
constexpr std::int32_t kHighest = (1 << 30) - 1;
constexpr std::uint8_t kHole = 255;
constexpr std::int32_t kMostRectangles = 3;

enum class Heights : std::uint8_t {
  kFew,       // 0 and a few more
  kByte,      // 0 to 254
  kWide,      // all over the range
  kCliffs,    // one of two heights far apart, and a few quanta
  kSlope,     // a plane, and a few quanta
  kParabola,  // a dome or a bowl, and a few quanta: every post nearly matters
};
constexpr std::uint8_t kKinds = 6;

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  std::uint8_t Byte() { return next_ < bytes_.size() ? bytes_[next_++] : std::uint8_t{0}; }
  std::int32_t Below(std::int32_t bound) { return Byte() % bound; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t next_ = 0;
};

std::int32_t Clamped(std::int64_t height) {
  return static_cast<std::int32_t>(
      std::clamp<std::int64_t>(height, -std::int64_t{kHighest}, kHighest));
}

// The height of a post from its own bytes; shape: the byte of the kind, beyond the kind itself.
class Ground {
 public:
  Ground(Heights kind, std::uint8_t shape) : kind_(kind), shape_(shape) {}

  std::int64_t At(std::int32_t c, std::int32_t r, std::uint8_t byte, Reader& reader) const {
    constexpr std::array<std::int32_t, 4> kFews{2, 3, 4, 10};
    const std::int32_t few = byte % 4;
    switch (kind_) {
      case Heights::kFew:
        return byte % kFews[shape_ % kFews.size()];
      case Heights::kByte:
        return byte;
      case Heights::kWide:
        return (std::int64_t{byte} << 23) + (std::int64_t{reader.Byte()} << 15) +
               (std::int64_t{reader.Byte()} << 7) + reader.Byte() / 2 - kHighest;
      case Heights::kCliffs:
        return (byte / 4 % 2 << (8 + shape_ % 23)) + few;
      case Heights::kSlope:
        return (shape_ % 7 - 3) * c + (shape_ / 7 % 6 - 2) * r + few / 3;
      case Heights::kParabola:
        return (shape_ % 2 == 0 ? -1 : 1) * 4 * ((c - 4) * (c - 4) + (r - 4) * (r - 4)) + few;
    }
    return 0;
  }

 private:
  Heights kind_;
  std::uint8_t shape_;
};

// Lays a plateau, a plane, a step or a hole over the posts of a rectangle.
void LayRectangle(Dem& dem, Reader& reader) {
  const std::int32_t what = reader.Byte();
  const std::int32_t corner = reader.Byte();
  const std::int32_t size = reader.Byte();
  const std::int32_t height = reader.Byte();
  const std::int32_t c0 = corner % 16 % dem.columns;
  const std::int32_t r0 = corner / 16 % dem.rows;
  const std::int32_t c1 = std::min(c0 + size % 16 % dem.columns, dem.columns - 1);
  const std::int32_t r1 = std::min(r0 + size / 16 % dem.rows, dem.rows - 1);
  for (std::int32_t r = r0; r <= r1; ++r) {
    for (std::int32_t c = c0; c <= c1; ++c) {
      const VertexId v = r * dem.columns + c;
      std::int32_t& h = dem.heights[static_cast<std::size_t>(v)];
      if (what % 4 == 0) h = height;
      if (what % 4 == 1) h = height + (what / 4 % 8 - 3) * (c - c0) + (what / 32 - 3) * (r - r0);
      if (what % 4 == 2 && h != kNoHeight) h = Clamped(h + (std::int64_t{height} << (what / 8)));
      if (what % 4 == 3) h = kNoHeight;
    }
  }
}

}  // namespace

Dem DemFromBytes(std::span<const std::uint8_t> bytes) {
  Reader reader(bytes);
  Dem dem;
  dem.columns = kLeastSide + reader.Below(kSides);
  dem.rows = kLeastSide + reader.Below(kSides);
  const std::uint8_t kind = reader.Byte();
  const Ground ground(static_cast<Heights>(kind % kKinds),
                      static_cast<std::uint8_t>(kind / kKinds));
  // Held back until the posts are there.
  std::vector<std::array<std::uint8_t, 4>> rectangles(
      static_cast<std::size_t>(reader.Below(kMostRectangles + 1)));
  for (std::array<std::uint8_t, 4>& rectangle : rectangles) {
    for (std::uint8_t& byte : rectangle) byte = reader.Byte();
  }
  for (std::int32_t r = 0; r < dem.rows; ++r) {
    for (std::int32_t c = 0; c < dem.columns; ++c) {
      const std::uint8_t byte = reader.Byte();
      dem.heights.push_back(byte == kHole ? kNoHeight : Clamped(ground.At(c, r, byte, reader)));
    }
  }
  for (const std::array<std::uint8_t, 4>& bytes_of_one : rectangles) {
    Reader rectangle(bytes_of_one);
    LayRectangle(dem, rectangle);
  }
  return dem;
}

}  // namespace farhorizon
