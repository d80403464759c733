#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

#include "core/io/mesh_files/file_mesh.h"
#include "core/io/mesh_files/gltf_json.h"
#include "core/io/mesh_files/stored_scalar.h"

namespace farhorizon {

/// The buffers of a glTF, its views of them and the accessors that are needed for triangles.
/// Methods throw nlohmann::json::exception where the JSON is not as glTF has it.
class GltfBuffers {
 public:
  /// json, bin: of the file; both outlive the object. folder: of files that it names.
  GltfBuffers(const MeshJson& json, std::span<const std::uint8_t> bin, std::filesystem::path folder,
              const MeshLimits& limits)
      : json_(&json), bin_(bin), folder_(std::move(folder)), limits_(limits) {}

  /// A buffer view: its bytes, valid as long as this object. stride: 0 where elements are packed.
  struct View {
    std::span<const std::uint8_t> bytes;
    std::uint64_t stride = 0;
  };
  /// Errors: "bad-mesh-file", "mesh-too-large"; kNotFound where a file is not there.
  Result<View> ViewOf(std::uint64_t index);

  /// Points of an accessor: VEC3 of any type of numbers, normalized or not
  /// [KHR_mesh_quantization].
  Result<std::vector<FilePoint>> Points(std::uint64_t accessor);
  /// Numbers of an accessor of indices.
  Result<std::vector<std::uint32_t>> Indices(std::uint64_t accessor);

 private:
  struct Elements {
    std::span<const std::uint8_t> bytes;
    std::uint64_t count = 0;
    std::uint64_t stride = 0;
    ScalarType type = ScalarType::kFloat;
  };
  Result<std::span<const std::uint8_t>> BufferOf(std::uint64_t index);
  // `length` bytes of a buffer from `offset`.
  Result<std::span<const std::uint8_t>> Piece(std::uint64_t buffer, std::uint64_t offset,
                                              std::uint64_t length);
  Result<View> Decompressed(std::uint64_t index, const MeshJson& extension);
  // Checked against the view, and against what may be read.
  Result<Elements> ElementsOf(const MeshJson& accessor, std::size_t components);
  Status Allocate(std::uint64_t bytes);

  const MeshJson* json_;
  std::span<const std::uint8_t> bin_;
  std::filesystem::path folder_;
  MeshLimits limits_;
  std::uint64_t allocated_ = 0;
  std::map<std::uint64_t, std::vector<std::uint8_t>> buffers_;  // that are not `bin`
  std::map<std::uint64_t, std::vector<std::uint8_t>> decompressed_;
};

}  // namespace farhorizon
