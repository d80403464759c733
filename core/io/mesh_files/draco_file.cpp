// A Draco bitstream of unknown origin. libdraco allocates by the numbers of faces and points that
// the stream states, before it finds that they are not there: they are read first, and refused.
//   header · metadata where flagged · traversal (edgebreaker alone) · two numbers · the rest
#include "core/io/mesh_files/draco_file.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#include <draco/metadata/metadata_decoder.h>

namespace farhorizon {

namespace {

constexpr int kOldestVersion = 0x0202;  // 2.2: Draco 1.3, of 2018

Error BadDraco(const std::string& message) {
  return BadMeshFile("the Draco mesh cannot be decoded: " + message);
}

draco::DecoderBuffer BufferOf(std::span<const std::uint8_t> bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return buffer;
}

// Reads the numbers of points and faces off the beginning of the stream and checks them.
Status CheckStatedCounts(std::span<const std::uint8_t> bytes, const MeshLimits& limits) {
  draco::DecoderBuffer buffer = BufferOf(bytes);
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) {
    return BadDraco("it does not begin as Draco does");
  }
  if (header.encoder_type != draco::TRIANGULAR_MESH) return BadDraco("it is a cloud of points");
  const int version = header.version_major * 256 + header.version_minor;
  if (version < kOldestVersion) {
    return BadDraco("its version is " + std::to_string(header.version_major) + "." +
                    std::to_string(header.version_minor) + "; 2.2 is the oldest that is read");
  }
  buffer.set_bitstream_version(static_cast<std::uint16_t>(version));
  if ((header.flags & METADATA_FLAG_MASK) != 0) {
    draco::GeometryMetadata metadata;
    if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) {
      return BadDraco("its metadata are damaged");
    }
  }
  const bool edgebreaker = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
  std::uint8_t traversal = 0;
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  if ((edgebreaker && !buffer.Decode(&traversal)) || !draco::DecodeVarint(&first, &buffer) ||
      !draco::DecodeVarint(&second, &buffer)) {
    return BadDraco("it is cut short");
  }
  // The sequential coder names faces first, edgebreaker vertices.
  return CheckCounts(edgebreaker ? first : second, edgebreaker ? second : first, limits);
}

// Applies the lattice that our own encoder names, if it is there and sound.
void ApplyLattice(const draco::Mesh& mesh, FileMesh& result) {
  const draco::GeometryMetadata* metadata = mesh.GetMetadata();
  if (metadata == nullptr) return;
  constexpr std::array<const char*, 3> kOrigin = {"lattice_origin_east", "lattice_origin_north",
                                                  "lattice_origin_up"};
  double step = 0;
  FilePoint origin{};
  bool there = metadata->GetEntryDouble("lattice_step", &step) && std::isfinite(step) && step > 0;
  for (std::size_t k = 0; there && k < 3; ++k) {
    there = metadata->GetEntryDouble(kOrigin[k], &origin[k]) && std::isfinite(origin[k]);
  }
  if (!there) return;
  for (FilePoint& p : result.points) {
    for (std::size_t k = 0; k < 3; ++k) p[k] = origin[k] + step * p[k];
  }
  result.frame = FileFrame::kTile;
}

}  // namespace

Result<FileMesh> ReadDracoMesh(std::span<const std::uint8_t> bytes,
                               std::optional<std::uint32_t> position, const MeshLimits& limits) {
  if (Status few = CheckStatedCounts(bytes, limits); !few) return std::move(few.error());
  draco::DecoderBuffer buffer = BufferOf(bytes);
  draco::Decoder decoder;
  draco::StatusOr<std::unique_ptr<draco::Mesh>> decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return BadDraco(decoded.status().error_msg_string());
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  if (Status few = CheckCounts(mesh->num_points(), mesh->num_faces(), limits); !few) {
    return std::move(few.error());
  }
  const draco::PointAttribute* attribute =
      position ? mesh->GetAttributeByUniqueId(*position)
               : mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  if (attribute == nullptr || attribute->num_components() != 3) {
    return BadDraco("it has no positions in three coordinates");
  }
  FileMesh result;
  result.points.resize(mesh->num_points());
  for (std::uint32_t i = 0; i < mesh->num_points(); ++i) {
    const draco::AttributeValueIndex value = attribute->mapped_index(draco::PointIndex(i));
    if (value.value() >= attribute->size() ||
        !attribute->ConvertValue<double>(value, 3, result.points[i].data())) {
      return BadDraco("point " + std::to_string(i) + " has no position");
    }
  }
  result.triangles.resize(mesh->num_faces());
  for (std::uint32_t i = 0; i < mesh->num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh->face(draco::FaceIndex(i));
    result.triangles[i] = {face[0].value(), face[1].value(), face[2].value()};
  }
  if (!position) ApplyLattice(*mesh, result);
  return result;
}

}  // namespace farhorizon
