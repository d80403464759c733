// All numbers are little-endian, and each view of the buffer begins at a multiple of 8, as
// EXT_structural_metadata asks of tables. Vertices come in the order in which chains need them, so
// that indices mostly rise by one, which gzip likes.
#include "core/io/horizon_glb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "core/io/glb.h"
#include "core/io/glb_container.h"
#include "core/io/gltf_numbers.h"

namespace farhorizon {

namespace {

using OrderedJson = nlohmann::ordered_json;

// Vertices begin at multiples of four bytes: three numbers of 16 bits take four.
constexpr std::size_t kShortStride = 8;
constexpr float kMostShort = 65535;
// The greatest index of a type would restart a primitive.
constexpr std::size_t kMostShortVertices = 65535;

constexpr char kQuantization[] = "KHR_mesh_quantization";
constexpr char kMetadata[] = "EXT_structural_metadata";
constexpr char kUnlit[] = "KHR_materials_unlit";
constexpr char kClass[] = "horizon_chain";

// The buffer and its views.
struct Binary {
  std::vector<std::uint8_t> bytes;
  OrderedJson views = OrderedJson::array();

  void Add(std::uint64_t number, std::size_t width) {
    for (std::size_t k = 0; k < width; ++k) {
      bytes.push_back(static_cast<std::uint8_t>(number >> (8 * k)));
    }
  }
  void Add(float number) { Add(std::bit_cast<std::uint32_t>(number), sizeof number); }

  // Makes what was added since `begin` a view, and returns the view's number.
  std::size_t EndView(std::size_t begin, int target = 0, std::size_t stride = 0) {
    views.push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes.size() - begin}});
    if (stride != 0) views.back()["byteStride"] = stride;
    if (target != 0) views.back()["target"] = target;
    bytes.resize(
        (bytes.size() + kHorizonGlbAlignment - 1) / kHorizonGlbAlignment * kHorizonGlbAlignment, 0);
    return views.size() - 1;
  }
};

// The points of all chains, each once, and the lines between them.
struct Graph {
  std::vector<HorizonGlbPoint> points;
  std::vector<std::size_t> indices;

  explicit Graph(const std::vector<LineChain>& chains) {
    std::map<HorizonGlbPoint, std::size_t> places;
    const auto place = [&](const HorizonGlbPoint& point) {
      const auto [at, is_new] = places.emplace(point, points.size());
      if (is_new) points.push_back(point);
      return at->second;
    };
    for (const LineChain& chain : chains) {
      for (std::size_t i = 0; i + 1 < chain.points.size(); ++i) {
        indices.push_back(place(chain.points[i]));
        indices.push_back(place(chain.points[i + 1]));
      }
    }
  }
};

OrderedJson PositionAccessor(const std::vector<HorizonGlbPoint>& points, Binary& binary) {
  HorizonGlbPoint least = points.front();
  HorizonGlbPoint greatest = least;
  for (const HorizonGlbPoint& point : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      least[k] = std::min(least[k], point[k]);
      greatest[k] = std::max(greatest[k], point[k]);
    }
  }
  const bool shorts = std::ranges::max(greatest) <= kMostShort;
  const std::size_t begin = binary.bytes.size();
  for (const HorizonGlbPoint& point : points) {
    for (const float x : point) {
      if (shorts) {
        binary.Add(static_cast<std::uint64_t>(x), 2);
      } else {
        binary.Add(x);
      }
    }
    if (shorts) binary.Add(0, 2);
  }
  const std::size_t view = binary.EndView(begin, gltf::kArrayBuffer, shorts ? kShortStride : 0);
  OrderedJson accessor = {{"bufferView", view},
                          {"componentType", shorts ? gltf::kUnsignedShort : gltf::kFloat},
                          {"count", points.size()},
                          {"type", "VEC3"}};
  const auto bounds = [shorts](const HorizonGlbPoint& p) {
    return shorts ? OrderedJson(std::array<int, 3>{static_cast<int>(p[0]), static_cast<int>(p[1]),
                                                   static_cast<int>(p[2])})
                  : OrderedJson(p);
  };
  accessor["min"] = bounds(least);
  accessor["max"] = bounds(greatest);
  return accessor;
}

OrderedJson IndexAccessor(const Graph& graph, Binary& binary) {
  const bool shorts = graph.points.size() <= kMostShortVertices;
  const std::size_t begin = binary.bytes.size();
  for (const std::size_t i : graph.indices) binary.Add(i, shorts ? 2 : 4);
  return {{"bufferView", binary.EndView(begin, gltf::kElementArrayBuffer)},
          {"componentType", shorts ? gltf::kUnsignedShort : gltf::kUnsignedInt},
          {"count", graph.indices.size()},
          {"type", "SCALAR"}};
}

// The class of the chains and its table, a column at a time. Descriptions are short: a coarse level
// has few edges to share their bytes.
class Table {
 public:
  Table(const std::vector<LineChain>& chains, Binary& binary) : chains_(chains), binary_(binary) {
    std::size_t most = 0;
    for (const LineChain& chain : chains) most = std::max(most, chain.points.size() - 1);
    const std::size_t width = most < 1U << 8U ? 1 : most < 1U << 16U ? 2 : 4;
    Add("edges", "SCALAR", "UINT" + std::to_string(8 * width),
        "How many of the primitive's lines, after those of the chains before it",
        [&](const LineChain& chain) { binary_.Add(chain.points.size() - 1, width); });
    Add("azimuths", "VEC2", "UINT32",
        "On the skyline: 64 bits, low 32 first, each 180/64 degrees clockwise from north",
        [&](const LineChain& chain) { binary_.Add(chain.azimuths, 8); });
    AddMeasure("line_measure_m", "Sum over the DEM's edges, radians times metres",
               &LineChain::line_measure_m);
    AddMeasure("skyline_drop_m", "Greatest of the DEM's edges, metres", &LineChain::skyline_drop_m);
  }

  [[nodiscard]] OrderedJson Extension() const {
    OrderedJson schema = {{"id", "farhorizon_horizon"}};
    schema["classes"][kClass]["properties"] = properties_;
    const OrderedJson table = {
        {"class", kClass}, {"count", chains_.size()}, {"properties", columns_}};
    return {{"schema", schema}, {"propertyTables", OrderedJson::array({table})}};
  }

 private:
  template <typename AddValue>
  void Add(const char* name, const char* type, const std::string& component,
           const char* description, AddValue add) {
    properties_[name] = {{"description", description},
                         {"type", type},
                         {"componentType", component},
                         {"required", true}};
    const std::size_t begin = binary_.bytes.size();
    for (const LineChain& chain : chains_) add(chain);
    columns_[name] = {{"values", binary_.EndView(begin)}};
  }

  void AddMeasure(const char* name, const char* description,
                  std::optional<float> LineChain::*measure) {
    Add(name, "SCALAR", "FLOAT32", description,
        [&](const LineChain& chain) { binary_.Add((chain.*measure).value_or(kUnsetMeasure)); });
    properties_[name].erase("required");
    properties_[name]["noData"] = static_cast<int>(kUnsetMeasure);
  }

  const std::vector<LineChain>& chains_;
  Binary& binary_;
  OrderedJson properties_;
  OrderedJson columns_;
};

OrderedJson Material() {
  OrderedJson material = {
      {"name", "horizon edge"},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {1, 0.25, 0, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}};
  material["extensions"][kUnlit] = OrderedJson::object();
  return material;
}

}  // namespace

std::vector<std::uint8_t> WriteHorizonGlb(const std::vector<LineChain>& chains,
                                          const QuantizationLattice& lattice) {
  Check(!chains.empty(), "a level has an outline, which has some of its skyline");
  const Graph graph(chains);
  Binary binary;
  OrderedJson accessors = OrderedJson::array({PositionAccessor(graph.points, binary)});
  accessors.push_back(IndexAccessor(graph, binary));
  const Table table(chains, binary);
  const bool quantized = accessors[0]["componentType"] == gltf::kUnsignedShort;
  const OrderedJson primitive = {
      {"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"mode", gltf::kLines}, {"material", 0}};

  OrderedJson gltf;
  gltf["asset"] = {{"version", "2.0"}, {"generator", "farhorizon"}};
  gltf["extensionsUsed"] = OrderedJson::array({kUnlit, kMetadata});
  if (quantized) {
    gltf["extensionsUsed"].push_back(kQuantization);
    gltf["extensionsRequired"] = OrderedJson::array({kQuantization});
  }
  gltf["extensions"][kMetadata] = table.Extension();
  gltf["scene"] = 0;
  gltf["scenes"] = OrderedJson::array({{{"nodes", {0}}}});
  gltf["nodes"] = OrderedJson::array({{{"mesh", 0}, {"matrix", GltfMatrix(lattice)}}});
  gltf["meshes"] = OrderedJson::array({{{"primitives", OrderedJson::array({primitive})}}});
  gltf["materials"] = OrderedJson::array({Material()});
  gltf["accessors"] = accessors;
  gltf["bufferViews"] = binary.views;
  gltf["buffers"] = OrderedJson::array({{{"byteLength", binary.bytes.size()}}});
  return JoinGlb(gltf.dump(), binary.bytes, kHorizonGlbAlignment);
}

}  // namespace farhorizon
