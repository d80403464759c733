// Writes and reads GLB: a header, a chunk of JSON and a chunk of bytes. The positions stay lattice
// numbers in the buffer; the root node's matrix makes metres of them. ReadGlb takes only what
// WriteGlb makes, and checks each offset, because verification reads files of unknown origin.
#include "core/io/glb.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/io/edge_visibility.h"
#include "core/io/glb_container.h"
#include "core/io/gltf_numbers.h"

namespace farhorizon {

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t kMaxShortVertices = 65535;  // 65535 itself restarts a strip

constexpr char kDraco[] = "KHR_draco_mesh_compression";
constexpr char kEdges[] = "EXT_mesh_primitive_edge_visibility";

void Pad(std::vector<std::uint8_t>& bytes, std::uint8_t with) {
  while (bytes.size() % 4 != 0) bytes.push_back(with);
}

// The buffer and its views.
struct Binary {
  std::vector<std::uint8_t> bytes;
  OrderedJson views = OrderedJson::array();

  // Appends `part` as a new view and returns the view's number.
  template <typename Byte>
  std::size_t Add(const std::vector<Byte>& part) {
    Pad(bytes, 0);
    views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", part.size()}});
    for (const Byte b : part) bytes.push_back(static_cast<std::uint8_t>(b));
    return views.size() - 1;
  }
};

OrderedJson PositionAccessor(const DecodedMesh& decoded) {
  const std::vector<Enu>& positions = decoded.mesh.positions;
  const LatticeBox box = LatticeBoxOf(positions, decoded.lattice);
  return {{"componentType", gltf::kFloat},
          {"count", positions.size()},
          {"type", "VEC3"},
          {"min", box.least},
          {"max", box.greatest}};
}

// The object of kEdges; adds its accessors and views. See FlagEdges.
OrderedJson EdgeExtension(const EdgeVisibility& edges, OrderedJson& accessors, Binary& binary) {
  OrderedJson extension;
  extension["visibility"] = accessors.size();
  accessors.push_back({{"bufferView", binary.Add(edges.bits)},
                       {"componentType", gltf::kUnsignedByte},
                       {"count", edges.bits.size()},
                       {"type", "SCALAR"}});
  extension["material"] = 1;
  if (!edges.normals.empty()) {
    extension["silhouetteNormals"] = accessors.size();
    accessors.push_back({{"bufferView", binary.Add(edges.normals)},
                         {"componentType", gltf::kByte},
                         {"normalized", true},
                         {"count", edges.normals.size() / 3},
                         {"type", "VEC3"}});
  }
  return extension;
}

OrderedJson Material(const char* name, std::array<double, 4> colour) {
  return {{"name", name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", colour}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
          {"doubleSided", false}};
}

// A primitive around a Draco bitstream; adds its accessors and view. Accessors of data in the
// bitstream have neither a view nor an offset.
OrderedJson Primitive(const std::vector<std::uint8_t>& draco, const DecodedMesh& decoded,
                      OrderedJson& accessors, Binary& binary) {
  const LocalMesh& mesh = decoded.mesh;
  const std::size_t view = binary.Add(draco);
  const std::size_t first = accessors.size();
  accessors.push_back(PositionAccessor(decoded));
  accessors.push_back(
      {{"componentType",
        mesh.positions.size() <= kMaxShortVertices ? gltf::kUnsignedShort : gltf::kUnsignedInt},
       {"count", 3 * mesh.triangles.size()},
       {"type", "SCALAR"}});
  accessors.push_back(
      {{"componentType", gltf::kFloat}, {"count", mesh.positions.size()}, {"type", "VEC3"}});
  OrderedJson primitive = {{"attributes", {{"POSITION", first}, {"NORMAL", first + 2}}},
                           {"indices", first + 1},
                           {"mode", gltf::kTriangles},
                           {"material", 0}};
  primitive["extensions"][kDraco] = {
      {"bufferView", view},
      {"attributes", {{"POSITION", kDracoPositionId}, {"NORMAL", kDracoNormalId}}}};
  return primitive;
}

Error NoGlbOfOurs(const std::string& message) {
  return {ErrorCode::kUnsupportedData, "no GLB of ours: " + message, "bad-glb"};
}

// The part of the buffer that a view names; nullopt where it lies outside.
std::optional<std::span<const std::uint8_t>> PartOf(std::span<const std::uint8_t> buffer,
                                                    const OrderedJson& view) {
  const auto offset = view.value("byteOffset", std::uint64_t{0});
  const auto length = view.at("byteLength").get<std::uint64_t>();
  if (offset > buffer.size() || length > buffer.size() - offset) return std::nullopt;
  return buffer.subspan(offset, length);
}

// What the extension of a primitive says of its edges; nullopt where it lies outside the buffer.
std::optional<EdgeVisibility> ReadEdges(const OrderedJson& gltf, const OrderedJson& extension,
                                        std::span<const std::uint8_t> buffer) {
  const auto part = [&](const char* name) {
    const OrderedJson& accessor = gltf.at("accessors").at(extension.at(name).get<std::size_t>());
    return PartOf(buffer, gltf.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>()));
  };
  EdgeVisibility edges;
  const auto bits = part("visibility");
  if (!bits) return std::nullopt;
  edges.bits.assign(bits->begin(), bits->end());
  if (!extension.contains("silhouetteNormals")) return edges;
  const auto normals = part("silhouetteNormals");
  if (!normals) return std::nullopt;
  edges.normals.assign(normals->begin(), normals->end());
  return edges;
}

// Errors: "bad-glb"; those of nlohmann::json are thrown.
Result<GlbPrimitive> ReadPrimitive(const OrderedJson& gltf, const OrderedJson& primitive,
                                   std::span<const std::uint8_t> bin) {
  const OrderedJson& extension = primitive.at("extensions").at(kDraco);
  const OrderedJson& accessors = gltf.at("accessors");
  const OrderedJson& position =
      accessors.at(primitive.at("attributes").at("POSITION").get<std::size_t>());
  const OrderedJson& normal =
      accessors.at(primitive.at("attributes").at("NORMAL").get<std::size_t>());
  const OrderedJson& view =
      gltf.at("bufferViews").at(extension.at("bufferView").get<std::size_t>());
  GlbPrimitive contents;
  contents.vertex_count = position.at("count").get<std::int64_t>();
  contents.normal_count = normal.at("count").get<std::int64_t>();
  contents.index_count =
      accessors.at(primitive.at("indices").get<std::size_t>()).at("count").get<std::int64_t>();
  contents.min = position.at("min").get<std::array<double, 3>>();
  contents.max = position.at("max").get<std::array<double, 3>>();
  const auto part = PartOf(bin, view);
  if (!part) return NoGlbOfOurs("the Draco bitstream lies outside the buffer");
  contents.draco.assign(part->begin(), part->end());
  return contents;
}

}  // namespace

std::array<double, 16> GltfMatrix(const QuantizationLattice& lattice) {
  const auto& [east, north, up] = lattice.origin;
  const double s = lattice.step_m;
  return {s, 0, 0, 0, 0, 0, -s, 0, 0, s, 0, 0, east, up, -north, 1};
}

std::vector<std::uint8_t> WriteGlb(const std::vector<std::uint8_t>& draco,
                                   const DecodedMesh& decoded, const EdgeVisibility& edges,
                                   const EncodedMesh* skirt) {
  Binary binary;
  OrderedJson accessors = OrderedJson::array();
  OrderedJson primitive = Primitive(draco, decoded, accessors, binary);
  OrderedJson materials = OrderedJson::array({Material("terrain", {0.62, 0.6, 0.55, 1})});
  OrderedJson used = OrderedJson::array({kDraco});
  if (edges.edge_count > 0) {
    primitive["extensions"][kEdges] = EdgeExtension(edges, accessors, binary);
    materials.push_back(Material("horizon edge", {1, 0.25, 0, 1}));
    used.push_back(kEdges);
  }
  OrderedJson primitives = OrderedJson::array({primitive});
  if (skirt != nullptr) {
    primitives.push_back(Primitive(skirt->draco, skirt->decoded, accessors, binary));
    primitives.back()["extras"] = {{"skirt", true}};
  }

  OrderedJson gltf;
  gltf["asset"] = {{"version", "2.0"}, {"generator", "farhorizon"}};
  gltf["extensionsUsed"] = used;
  gltf["extensionsRequired"] = OrderedJson::array({kDraco});
  gltf["scene"] = 0;
  gltf["scenes"] = OrderedJson::array({{{"nodes", {0}}}});
  gltf["nodes"] = OrderedJson::array({{{"mesh", 0}, {"matrix", GltfMatrix(decoded.lattice)}}});
  gltf["meshes"] = OrderedJson::array({{{"primitives", primitives}}});
  gltf["materials"] = materials;
  gltf["accessors"] = accessors;
  gltf["bufferViews"] = binary.views;
  gltf["buffers"] = OrderedJson::array({{{"byteLength", binary.bytes.size()}}});
  return JoinGlb(gltf.dump(), binary.bytes);
}

Result<GlbContents> ReadGlb(const std::vector<std::uint8_t>& bytes) {
  Result<GlbChunks> chunks = SplitGlb(bytes);
  if (!chunks) return NoGlbOfOurs(chunks.error().message);
  if (bytes.size() !=
      gltf::kHeaderBytes + 2 * gltf::kChunkHeaderBytes + chunks->json.size() + chunks->bin.size()) {
    return NoGlbOfOurs("it is more than a header and two chunks");
  }
  try {
    const OrderedJson gltf = OrderedJson::parse(chunks->json.begin(), chunks->json.end());
    const OrderedJson& primitives = gltf.at("meshes").at(0).at("primitives");
    GlbContents contents;
    contents.matrix = gltf.at("nodes").at(0).at("matrix").get<std::array<double, 16>>();
    Result<GlbPrimitive> surface = ReadPrimitive(gltf, primitives.at(0), chunks->bin);
    if (!surface) return std::move(surface.error());
    contents.surface = *std::move(surface);
    const OrderedJson& extensions = primitives.at(0).at("extensions");
    if (extensions.contains(kEdges)) {
      std::optional<EdgeVisibility> edges = ReadEdges(gltf, extensions.at(kEdges), chunks->bin);
      if (!edges) return NoGlbOfOurs("its edges lie outside the buffer");
      contents.edges = *std::move(edges);
    }
    if (primitives.size() > 1) {
      Result<GlbPrimitive> skirt = ReadPrimitive(gltf, primitives.at(1), chunks->bin);
      if (!skirt) return std::move(skirt.error());
      contents.skirt = *std::move(skirt);
    }
    return contents;
  } catch (const nlohmann::json::exception& failure) {
    return NoGlbOfOurs(failure.what());
  }
}

}  // namespace farhorizon
