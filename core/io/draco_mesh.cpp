// Meshes to Draco bitstreams and back. Positions go in as lattice numbers, which Draco's
// quantisation leaves as they are, so that what is decoded is known before: SnapToLattice.
// Everything that is decoded is checked, because verification reads files of unknown origin.
#include "core/io/draco_mesh.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

namespace farhorizon {

namespace {

// How an attribute is stored, and the unique id by which it is found.
struct AttributeForm {
  int id;
  std::int8_t components;
  draco::DataType type;
};
constexpr AttributeForm kPosition = {kDracoPositionId, 3, draco::DT_FLOAT32};
constexpr AttributeForm kPost = {kDracoPostId, 1, draco::DT_UINT32};
constexpr AttributeForm kNormal = {kDracoNormalId, 3, draco::DT_FLOAT32};
// 8 bits turn a normal by half a degree, which no shading shows; each further bit costs a quarter
// of a byte a vertex or more. kLeastNormalUp relies on it.
constexpr int kNormalBits = 8;
// Draco's scale is 0 (slowest, smallest) to 10, its default 5. Any value is sound. 1 predicts a
// position from several parallelograms, where 3 takes one: 6 % fewer bytes for twice the time to
// encode and a sixth more to decode in a browser; 0 saves no more, 5 and up lose a fifth.
constexpr int kEncodingSpeed = 1;
constexpr std::array<const char*, 3> kOriginNames = {"lattice_origin_east", "lattice_origin_north",
                                                     "lattice_origin_up"};
constexpr char kStepName[] = "lattice_step";

Error BadMesh(const std::string& message) {
  return {ErrorCode::kUnsupportedData, message, "bad-mesh"};
}

Status CheckMesh(const LocalMesh& mesh) {
  Check(mesh.positions.size() == mesh.posts.size(), "as many posts as positions");
  Check(mesh.positions.size() == mesh.normals.size(), "as many normals as positions");
  for (const auto& [east, north, up] : mesh.normals) {
    // Far above what rounding does to a normal, far below what 8 bits can tell.
    Check(std::abs(std::hypot(east, north, up) - 1) < 1e-6, "a normal has length 1");
  }
  if (mesh.triangles.empty() || mesh.posts.empty()) return BadMesh("the mesh has no triangle");
  const std::uint32_t greatest = *std::ranges::max_element(mesh.posts);
  if (greatest > kMaxPost) {
    return BadMesh("post " + std::to_string(greatest) + " is beyond " + std::to_string(kMaxPost));
  }
  std::vector<bool> used(mesh.positions.size(), false);
  for (const auto& [a, b, c] : mesh.triangles) {
    if (std::max({a, b, c}) >= mesh.positions.size()) {
      return BadMesh("a triangle names vertex " + std::to_string(std::max({a, b, c})) + " of " +
                     std::to_string(mesh.positions.size()));
    }
    if (a == b || b == c || c == a) return BadMesh("a triangle names a vertex twice");
    used[a] = used[b] = used[c] = true;
  }
  const auto unused = std::ranges::find(used, false);
  if (unused != used.end()) {
    return BadMesh("vertex " + std::to_string(unused - used.begin()) + " is in no triangle");
  }
  return Ok{};
}

// Adds one that has the unique id by which clients ask for it. References to attributes that were
// added before stay valid.
draco::PointAttribute& AddAttribute(draco::Mesh& mesh, const AttributeForm& form,
                                    draco::GeometryAttribute::Type type, std::size_t count) {
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, static_cast<std::uint8_t>(form.components), form.type, false,
                 std::int64_t{form.components} * draco::DataTypeLength(form.type), 0);
  const int index = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(count));
  mesh.attribute(index)->set_unique_id(static_cast<std::uint32_t>(form.id));
  return *mesh.attribute(index);
}

std::array<float, 3> ToFloat(const std::array<double, 3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

std::unique_ptr<draco::GeometryMetadata> MetadataOf(const QuantizationLattice& lattice) {
  auto metadata = std::make_unique<draco::GeometryMetadata>();
  for (std::size_t i = 0; i < 3; ++i) {
    metadata->AddEntryDouble(kOriginNames[i], lattice.origin[i]);
  }
  metadata->AddEntryDouble(kStepName, lattice.step_m);
  return metadata;
}

std::unique_ptr<draco::Mesh> ToDraco(const LocalMesh& mesh, const QuantizationLattice& lattice,
                                     DracoPosts posts) {
  auto result = std::make_unique<draco::Mesh>();
  const std::size_t count = mesh.positions.size();
  result->set_num_points(static_cast<std::uint32_t>(count));
  draco::PointAttribute& position =
      AddAttribute(*result, kPosition, draco::GeometryAttribute::POSITION, count);
  draco::PointAttribute* post =
      posts == DracoPosts::kLeftOut
          ? nullptr
          : &AddAttribute(*result, kPost, draco::GeometryAttribute::GENERIC, count);
  draco::PointAttribute& normal =
      AddAttribute(*result, kNormal, draco::GeometryAttribute::NORMAL, count);
  for (std::size_t i = 0; i < count; ++i) {
    const draco::AttributeValueIndex index(static_cast<std::uint32_t>(i));
    const std::array<float, 3> xyz = ToFloat(LatticeNumbers(mesh.positions[i], lattice));
    const std::array<float, 3> upwards = ToFloat(mesh.normals[i]);
    position.SetAttributeValue(index, xyz.data());
    if (post != nullptr) post->SetAttributeValue(index, &mesh.posts[i]);
    normal.SetAttributeValue(index, upwards.data());
  }
  result->SetNumFaces(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    result->SetFace(draco::FaceIndex(static_cast<std::uint32_t>(i)),
                    {draco::PointIndex(a), draco::PointIndex(b), draco::PointIndex(c)});
  }
  result->AddMetadata(MetadataOf(lattice));
  return result;
}

Error BadDraco(const std::string& message) {
  return {ErrorCode::kUnsupportedData, "no Draco mesh of ours: " + message, "bad-draco"};
}

struct Attributes {
  const draco::PointAttribute* position = nullptr;
  const draco::PointAttribute* post = nullptr;  // null in a stream without posts
  const draco::PointAttribute* normal = nullptr;
};

Result<Attributes> AttributesOf(const draco::Mesh& mesh) {
  const auto find = [&](const AttributeForm& form,
                        draco::GeometryAttribute::Type type) -> const draco::PointAttribute* {
    const draco::PointAttribute* found =
        mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(form.id));
    const bool fits = found != nullptr && found->attribute_type() == type &&
                      found->num_components() == form.components && found->data_type() == form.type;
    return fits ? found : nullptr;
  };
  const Attributes result = {find(kPosition, draco::GeometryAttribute::POSITION),
                             find(kPost, draco::GeometryAttribute::GENERIC),
                             find(kNormal, draco::GeometryAttribute::NORMAL)};
  if (result.position == nullptr) return BadDraco("attribute 0 is not POSITION in three floats");
  if (result.normal == nullptr) return BadDraco("attribute 2 is not NORMAL in three floats");
  const bool other = result.post == nullptr &&
                     mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(kPost.id)) != nullptr;
  if (other) return BadDraco("attribute 1 is not GENERIC in one 32-bit number");
  return result;
}

// The lattice that the metadata names, with 1 bit: ReadVertices finds how many the positions need.
Result<QuantizationLattice> LatticeOf(const draco::Mesh& mesh) {
  const draco::GeometryMetadata* metadata = mesh.GetMetadata();
  QuantizationLattice lattice;
  lattice.bits = 1;
  bool there = metadata != nullptr && metadata->GetEntryDouble(kStepName, &lattice.step_m);
  for (std::size_t i = 0; there && i < 3; ++i) {
    there = metadata->GetEntryDouble(kOriginNames[i], &lattice.origin[i]);
  }
  if (!there) return BadDraco("its metadata do not name the lattice's origin and step");
  int exponent = 0;
  const bool power = std::isfinite(lattice.step_m) && std::frexp(lattice.step_m, &exponent) == 0.5;
  const bool multiples = power && std::ranges::all_of(lattice.origin, [&](double origin) {
                           return std::isfinite(origin) && std::fmod(origin, lattice.step_m) == 0;
                         });
  if (!multiples || !ExactInFloat(lattice)) {
    return BadDraco("its lattice's step is no power of two, or the origin no small multiple of it");
  }
  return lattice;
}

bool IsLatticeNumber(float x) {
  constexpr float kEnd = 1U << unsigned{kMaxLatticeBits};
  return x >= 0 && x < kEnd && std::floor(x) == x;
}

// Reads positions, posts and normals, and sets the lattice's bits to as many as hold the positions.
Status ReadVertices(const draco::Mesh& mesh, const Attributes& attributes, DecodedMesh& result) {
  QuantizationLattice& lattice = result.lattice;
  LocalMesh& local = result.mesh;
  local.positions.reserve(mesh.num_points());
  if (attributes.post != nullptr) local.posts.reserve(mesh.num_points());
  local.normals.reserve(mesh.num_points());
  float last = 1;
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::PointIndex point(i);
    std::array<float, 3> number{};
    std::array<float, 3> normal{};
    attributes.position->GetMappedValue(point, number.data());
    attributes.normal->GetMappedValue(point, normal.data());
    if (!std::ranges::all_of(number, IsLatticeNumber)) {
      return BadDraco("a position is no lattice number of " + std::to_string(kMaxLatticeBits) +
                      " bits");
    }
    last = std::max(last, *std::ranges::max_element(number));
    const auto coordinate = [&](std::size_t axis) {
      return lattice.origin[axis] + number[axis] * lattice.step_m;
    };
    local.positions.push_back({coordinate(0), coordinate(1), coordinate(2)});
    if (attributes.post != nullptr) {
      attributes.post->GetMappedValue(point, &local.posts.emplace_back());
    }
    local.normals.push_back({normal[0], normal[1], normal[2]});
  }
  std::frexp(last, &lattice.bits);  // last < 2^bits
  return Ok{};
}

}  // namespace

Result<std::vector<std::uint8_t>> EncodeDraco(const LocalMesh& mesh,
                                              const QuantizationLattice& lattice,
                                              DracoPosts posts) {
  Check(lattice.bits >= 1 && lattice.bits <= kMaxLatticeBits && ExactInFloat(lattice),
        "a bad lattice");
  if (Status sound = CheckMesh(mesh); !sound) return std::move(sound.error());
  const std::unique_ptr<draco::Mesh> whole = ToDraco(mesh, lattice, posts);

  draco::ExpertEncoder encoder(*whole);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetSpeedOptions(kEncodingSpeed, kEncodingSpeed);
  encoder.SetTrackEncodedProperties(true);
  // Draco's step is range / (2^bits - 1): 1, so that it changes no lattice number.
  constexpr std::array<float, 3> kOrigin = {0, 0, 0};
  const double range = std::ldexp(1.0, lattice.bits) - 1;
  const auto index = [&whole](const AttributeForm& form) {
    return whole->GetAttributeIdByUniqueId(static_cast<std::uint32_t>(form.id));
  };
  encoder.SetAttributeExplicitQuantization(index(kPosition), lattice.bits, 3, kOrigin.data(),
                                           static_cast<float>(range));
  encoder.SetAttributeQuantization(index(kNormal), kNormalBits);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeToBuffer(&buffer);
  if (!status.ok()) return BadMesh("Draco refuses the mesh: " + status.error_msg_string());
  if (encoder.num_encoded_faces() != mesh.triangles.size()) {
    return BadMesh("Draco kept " + std::to_string(encoder.num_encoded_faces()) + " of " +
                   std::to_string(mesh.triangles.size()) + " triangles");
  }
  return std::vector<std::uint8_t>(buffer.data(), buffer.data() + buffer.size());
}

Result<DecodedMesh> DecodeDraco(const std::vector<std::uint8_t>& bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  draco::StatusOr<std::unique_ptr<draco::Mesh>> decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return BadDraco(decoded.status().error_msg_string());
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  Result<Attributes> attributes = AttributesOf(*mesh);
  if (!attributes) return std::move(attributes.error());
  Result<QuantizationLattice> lattice = LatticeOf(*mesh);
  if (!lattice) return std::move(lattice.error());
  DecodedMesh result;
  result.lattice = *lattice;
  if (Status read = ReadVertices(*mesh, *attributes, result); !read) {
    return std::move(read.error());
  }
  result.mesh.triangles.reserve(mesh->num_faces());
  for (std::uint32_t i = 0; i < mesh->num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh->face(draco::FaceIndex(i));
    result.mesh.triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
    for (const std::uint32_t v : result.mesh.triangles.back()) {
      if (v >= result.mesh.positions.size()) {
        return BadDraco("a triangle names a vertex that is not there");
      }
    }
  }
  return result;
}

}  // namespace farhorizon
