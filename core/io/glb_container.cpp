// Numbers of the glTF 2.0 specification: a header of 12 bytes (magic, version, length), then chunks
// of 8 bytes (length, type) and their content.
#include "core/io/glb_container.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "core/io/gltf_numbers.h"

namespace farhorizon {

namespace {

constexpr std::uint32_t kMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinChunk = 0x004E4942;

std::uint32_t LittleEndianAt(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t{bytes[at + i]} << (8 * i);
  return value;
}

void AppendLittleEndian(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

// Appends a chunk and as many bytes `with` as bring the file to a multiple of `alignment`.
template <typename Bytes>
void AppendChunk(std::vector<std::uint8_t>& glb, std::uint32_t type, const Bytes& content,
                 std::uint8_t with, std::size_t alignment) {
  const std::size_t end = glb.size() + gltf::kChunkHeaderBytes + content.size();
  const std::size_t padding = (alignment - end % alignment) % alignment;
  AppendLittleEndian(glb, static_cast<std::uint32_t>(content.size() + padding));
  AppendLittleEndian(glb, type);
  glb.insert(glb.end(), content.begin(), content.end());
  glb.insert(glb.end(), padding, with);
}

Error BadGlb(const std::string& message) {
  return {ErrorCode::kUnsupportedData, message, "bad-glb"};
}

// Takes a chunk of `type` off the front of `rest`.
Result<std::span<const std::uint8_t>> TakeChunk(std::span<const std::uint8_t>& rest,
                                                std::uint32_t type, const char* name) {
  if (rest.size() < gltf::kChunkHeaderBytes || LittleEndianAt(rest, 4) != type) {
    return BadGlb(std::string("its chunk ") + name + " is missing");
  }
  const std::size_t size = LittleEndianAt(rest, 0);
  rest = rest.subspan(gltf::kChunkHeaderBytes);
  if (size > rest.size()) return BadGlb(std::string("its chunk ") + name + " is cut short");
  const std::span<const std::uint8_t> chunk = rest.first(size);
  rest = rest.subspan(size);
  return chunk;
}

}  // namespace

std::vector<std::uint8_t> JoinGlb(std::string_view json, std::span<const std::uint8_t> buffer,
                                  std::size_t alignment) {
  Check(json.size() + buffer.size() < 0xFFFF0000U, "a GLB beyond 4 GiB");
  std::vector<std::uint8_t> glb;
  glb.reserve(gltf::kHeaderBytes + 2 * (gltf::kChunkHeaderBytes + alignment) + json.size() +
              buffer.size());
  AppendLittleEndian(glb, kMagic);
  AppendLittleEndian(glb, 2);
  AppendLittleEndian(glb, 0);  // the length, below
  // The buffer begins behind the header of its chunk, of 8 bytes.
  AppendChunk(glb, kJsonChunk, json, ' ', alignment);
  AppendChunk(glb, kBinChunk, buffer, 0, alignment);
  std::vector<std::uint8_t> length;
  AppendLittleEndian(length, static_cast<std::uint32_t>(glb.size()));
  std::copy(length.begin(), length.end(), glb.begin() + 8);
  return glb;
}

bool IsGlb(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= gltf::kHeaderBytes && LittleEndianAt(bytes, 0) == kMagic;
}

Result<GlbChunks> SplitGlb(std::span<const std::uint8_t> bytes) {
  if (!IsGlb(bytes) || LittleEndianAt(bytes, 4) != 2) {
    return BadGlb("it does not begin as glTF binary 2 does");
  }
  const std::size_t length = LittleEndianAt(bytes, 8);
  if (length < gltf::kHeaderBytes || length > bytes.size()) {
    return BadGlb("it has " + std::to_string(bytes.size()) + " bytes, its header says " +
                  std::to_string(length));
  }
  std::span<const std::uint8_t> rest =
      bytes.subspan(gltf::kHeaderBytes, length - gltf::kHeaderBytes);
  GlbChunks chunks;
  Result<std::span<const std::uint8_t>> json = TakeChunk(rest, kJsonChunk, "JSON");
  if (!json) return std::move(json.error());
  chunks.json = *json;
  if (rest.empty()) return chunks;
  Result<std::span<const std::uint8_t>> bin = TakeChunk(rest, kBinChunk, "BIN");
  if (!bin) return std::move(bin.error());
  chunks.bin = *bin;
  return chunks;
}

}  // namespace farhorizon
