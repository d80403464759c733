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

constexpr int kMaxBits = 16;
constexpr int kFloatBits = 24;
constexpr int kPositionId = 0;
constexpr int kSourceId = 1;
// Draco's scale runs from 0 (slowest, smallest) to 10; its own default is 5.
constexpr int kEncodingSpeed = 3;

std::array<double, 3> Axes(const Enu& p) { return {p.east, p.north, p.up}; }

struct Box {
  std::array<double, 3> least;
  std::array<double, 3> greatest;
};

Box BoxOf(const std::vector<Enu>& points) {
  Check(!points.empty(), "a lattice over no points");
  Box box = {Axes(points[0]), Axes(points[0])};
  for (const Enu& point : points) {
    const std::array<double, 3> p = Axes(point);
    for (std::size_t i = 0; i < 3; ++i) {
      box.least[i] = std::min(box.least[i], p[i]);
      box.greatest[i] = std::max(box.greatest[i], p[i]);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    Check(std::isfinite(box.least[i]) && std::isfinite(box.greatest[i]), "a point is not finite");
  }
  return box;
}

// Index of the lattice position nearest to `value`; exact but for one division by a power of two.
double IndexOf(double value, double origin, double step) {
  return std::nearbyint((value - origin) / step);
}

// The lattice of this step over the box; bits may come out as more than are allowed.
QuantizationLattice LatticeOver(const Box& box, double step) {
  QuantizationLattice lattice;
  lattice.step_m = step;
  double last = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    lattice.origin[i] = std::floor(box.least[i] / step) * step;
    last = std::max(last, IndexOf(box.greatest[i], lattice.origin[i], step));
  }
  std::frexp(last, &lattice.bits);  // last < 2^bits
  return lattice;
}

// Every position is a sum that float holds without rounding.
bool ExactInFloat(const QuantizationLattice& lattice) {
  const double limit = std::ldexp(1.0, kFloatBits);
  return std::ranges::all_of(lattice.origin, [&](double origin) {
    return std::abs(origin) / lattice.step_m + std::ldexp(1.0, lattice.bits) <= limit;
  });
}

Error BadMesh(const std::string& message) {
  return {ErrorCode::kUnsupportedData, message, "bad-mesh"};
}

Status CheckMesh(const LocalMesh& mesh) {
  Check(mesh.positions.size() == mesh.sources.size(), "as many sources as positions");
  if (mesh.triangles.empty() || mesh.sources.empty()) return BadMesh("the mesh has no triangle");
  const std::uint32_t greatest = *std::ranges::max_element(mesh.sources);
  if (greatest > kMaxSource) {
    return BadMesh("source " + std::to_string(greatest) + " is beyond " +
                   std::to_string(kMaxSource));
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
  return Done{};
}

int AddAttribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, std::int8_t components,
                 draco::DataType data_type, std::size_t count) {
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, static_cast<std::uint8_t>(components), data_type, false,
                 static_cast<std::int64_t>(components) * draco::DataTypeLength(data_type), 0);
  return mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(count));
}

std::unique_ptr<draco::Mesh> ToDraco(const LocalMesh& mesh, const QuantizationLattice& lattice) {
  auto result = std::make_unique<draco::Mesh>();
  const std::size_t count = mesh.positions.size();
  result->set_num_points(static_cast<std::uint32_t>(count));
  const int position =
      AddAttribute(*result, draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32, count);
  const int source =
      AddAttribute(*result, draco::GeometryAttribute::GENERIC, 1, draco::DT_UINT32, count);
  Check(position == kPositionId && source == kSourceId, "Draco numbers attributes as they come");
  for (std::size_t i = 0; i < count; ++i) {
    const draco::AttributeValueIndex index(static_cast<std::uint32_t>(i));
    const Enu p = SnapToLattice(mesh.positions[i], lattice);
    const std::array<float, 3> xyz = {static_cast<float>(p.east), static_cast<float>(p.north),
                                      static_cast<float>(p.up)};
    result->attribute(position)->SetAttributeValue(index, xyz.data());
    result->attribute(source)->SetAttributeValue(index, &mesh.sources[i]);
  }
  result->SetNumFaces(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    result->SetFace(draco::FaceIndex(static_cast<std::uint32_t>(i)),
                    {draco::PointIndex(a), draco::PointIndex(b), draco::PointIndex(c)});
  }
  return result;
}

Error BadDraco(const std::string& message) {
  return {ErrorCode::kUnsupportedData, "no Draco mesh of ours: " + message, "bad-draco"};
}

}  // namespace

QuantizationLattice ChooseLattice(const std::vector<Enu>& points, double wanted_step_m) {
  Check(wanted_step_m > 0 && std::isfinite(wanted_step_m), "a lattice without step");
  const Box box = BoxOf(points);
  int exponent = 0;
  std::frexp(wanted_step_m, &exponent);  // 2^(exponent - 1) <= wanted < 2^exponent
  for (double step = std::ldexp(1.0, exponent - 1);; step *= 2) {
    const QuantizationLattice lattice = LatticeOver(box, step);
    if (lattice.bits <= kMaxBits && ExactInFloat(lattice)) return lattice;
  }
}

Enu SnapToLattice(const Enu& point, const QuantizationLattice& lattice) {
  const auto snap = [&](double value, std::size_t axis) {
    const double index = IndexOf(value, lattice.origin[axis], lattice.step_m);
    Check(index >= 0 && index < std::ldexp(1.0, lattice.bits), "a position outside its lattice");
    return lattice.origin[axis] + index * lattice.step_m;
  };
  return {snap(point.east, 0), snap(point.north, 1), snap(point.up, 2)};
}

Result<std::vector<std::uint8_t>> EncodeDraco(const LocalMesh& mesh,
                                              const QuantizationLattice& lattice) {
  Check(lattice.bits >= 1 && lattice.bits <= kMaxBits && ExactInFloat(lattice), "a bad lattice");
  if (Status sound = CheckMesh(mesh); !sound) return std::move(sound.error());
  const std::unique_ptr<draco::Mesh> source = ToDraco(mesh, lattice);

  draco::ExpertEncoder encoder(*source);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetSpeedOptions(kEncodingSpeed, kEncodingSpeed);
  encoder.SetTrackEncodedProperties(true);
  const std::array<float, 3> origin = {static_cast<float>(lattice.origin[0]),
                                       static_cast<float>(lattice.origin[1]),
                                       static_cast<float>(lattice.origin[2])};
  // Draco's step is range / (2^bits - 1): a power of two, so its float arithmetic is exact.
  const double range = lattice.step_m * (std::ldexp(1.0, lattice.bits) - 1);
  encoder.SetAttributeExplicitQuantization(kPositionId, lattice.bits, 3, origin.data(),
                                           static_cast<float>(range));
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeToBuffer(&buffer);
  if (!status.ok()) return BadMesh("Draco refuses the mesh: " + status.error_msg_string());
  if (encoder.num_encoded_faces() != mesh.triangles.size()) {
    return BadMesh("Draco kept " + std::to_string(encoder.num_encoded_faces()) + " of " +
                   std::to_string(mesh.triangles.size()) + " triangles");
  }
  return std::vector<std::uint8_t>(buffer.data(), buffer.data() + buffer.size());
}

Result<LocalMesh> DecodeDraco(const std::vector<std::uint8_t>& bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  draco::StatusOr<std::unique_ptr<draco::Mesh>> decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return BadDraco(decoded.status().error_msg_string());
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  const draco::PointAttribute* position = mesh->GetAttributeByUniqueId(kPositionId);
  const draco::PointAttribute* source = mesh->GetAttributeByUniqueId(kSourceId);
  if (position == nullptr || position->attribute_type() != draco::GeometryAttribute::POSITION ||
      position->num_components() != 3 || position->data_type() != draco::DT_FLOAT32) {
    return BadDraco("attribute 0 is not POSITION in three floats");
  }
  if (source == nullptr || source->attribute_type() != draco::GeometryAttribute::GENERIC ||
      source->num_components() != 1 || source->data_type() != draco::DT_UINT32) {
    return BadDraco("attribute 1 is not GENERIC in one 32-bit number");
  }
  LocalMesh result;
  result.positions.reserve(mesh->num_points());
  result.sources.reserve(mesh->num_points());
  for (std::uint32_t i = 0; i < mesh->num_points(); ++i) {
    const draco::PointIndex point(i);
    std::array<float, 3> xyz{};
    std::uint32_t number = 0;
    position->GetMappedValue(point, xyz.data());
    source->GetMappedValue(point, &number);
    result.positions.push_back({xyz[0], xyz[1], xyz[2]});
    result.sources.push_back(number);
  }
  result.triangles.reserve(mesh->num_faces());
  for (std::uint32_t i = 0; i < mesh->num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh->face(draco::FaceIndex(i));
    result.triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
    for (const std::uint32_t v : result.triangles.back()) {
      if (v >= result.positions.size())
        return BadDraco("a triangle names a vertex that is not there");
    }
  }
  return result;
}

}  // namespace farhorizon
