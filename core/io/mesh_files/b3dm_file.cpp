// b3dm: a header of 28 bytes with the lengths of four parts, the feature table's JSON and bytes,
// the batch table's, then a glTF binary. RTC_CENTER of the feature table moves the model in the
// tile's axes, z up, after it was turned.
#include "core/io/mesh_files/b3dm_file.h"

#include <array>
#include <string>
#include <utility>

#include "core/io/mesh_files/gltf_file.h"
#include "core/io/mesh_files/gltf_json.h"
#include "core/io/mesh_files/placing_matrix.h"
#include "core/io/mesh_files/stored_scalar.h"

namespace farhorizon {

namespace {

constexpr std::size_t kHeaderBytes = 28;
constexpr std::size_t kLengthsAt = 12;

}  // namespace

Result<FileMesh> ReadB3dm(std::span<const std::uint8_t> bytes, const std::filesystem::path& folder,
                          const MeshLimits& limits) {
  if (bytes.size() < kHeaderBytes) return BadMeshFile("the b3dm is cut short");
  std::array<std::span<const std::uint8_t>, 4> parts;
  std::span<const std::uint8_t> rest = bytes.subspan(kHeaderBytes);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t length = Uint32At(bytes.data() + kLengthsAt + 4 * i);
    if (length > rest.size()) return BadMeshFile("the b3dm is cut short");
    parts[i] = rest.first(length);
    rest = rest.subspan(length);
  }
  Result<FileMesh> mesh = ReadGltf(rest, folder, limits);
  if (!mesh || parts[0].empty()) return mesh;
  Result<MeshJson> features =
      ParseMeshJson({reinterpret_cast<const char*>(parts[0].data()), parts[0].size()});
  if (!features) return std::move(features.error());
  const MeshJson* centre = Member(*features, "RTC_CENTER");
  if (centre == nullptr) return mesh;
  try {
    // In glTF's axes, which the caller turns to z up.
    const auto at = centre->get<FilePoint>();
    Place(MatrixOf({at[0], at[2], -at[1]}, {0, 0, 0, 1}, {1, 1, 1}), *mesh);
  } catch (const nlohmann::json::exception& failure) {
    return BadMeshFile(std::string("RTC_CENTER of the b3dm: ") + failure.what());
  }
  return mesh;
}

}  // namespace farhorizon
