// Vertices are not shared, because a vertex has one feature. All numbers are little-endian, four
// bytes each, and each view of the buffer begins at a multiple of 8, as EXT_structural_metadata
// asks of tables. ReadHorizonGlb takes only what WriteHorizonGlb makes, and checks each offset.
#include "core/io/horizon_glb.h"

#include <algorithm>
#include <bit>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "core/io/glb.h"
#include "core/io/glb_container.h"

namespace farhorizon {

namespace {

using Json = nlohmann::ordered_json;

// Numbers of the glTF 2.0 specification.
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr int kLines = 1;
constexpr std::size_t kAlignment = 8;
constexpr std::size_t kNumberBytes = 4;
// Feature numbers are floats.
constexpr std::size_t kMostFeatures = std::size_t{1} << 24U;
// Stands for a measure that is unset.
constexpr float kNoData = -1;

constexpr char kFeatures[] = "EXT_mesh_features";
constexpr char kMetadata[] = "EXT_structural_metadata";
constexpr char kUnlit[] = "KHR_materials_unlit";
constexpr char kClass[] = "horizon_edge";

// The buffer and its views.
struct Binary {
  std::vector<std::uint8_t> bytes;
  Json views = Json::array();

  void Add(std::uint32_t number) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
      bytes.push_back(static_cast<std::uint8_t>(number >> shift));
    }
  }
  void Add(float number) { Add(std::bit_cast<std::uint32_t>(number)); }

  // Makes what was added since `begin` a view, and returns the view's number.
  std::size_t EndView(std::size_t begin, int target = 0) {
    views.push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes.size() - begin}});
    if (target != 0) views.back()["target"] = target;
    bytes.resize((bytes.size() + kAlignment - 1) / kAlignment * kAlignment, 0);
    return views.size() - 1;
  }
};

Json PositionAccessor(const std::vector<HorizonLine>& lines, std::size_t view) {
  std::array<float, 3> least = lines.front().ends[0];
  std::array<float, 3> greatest = least;
  for (const HorizonLine& line : lines) {
    for (const std::array<float, 3>& end : line.ends) {
      for (std::size_t k = 0; k < 3; ++k) {
        least[k] = std::min(least[k], end[k]);
        greatest[k] = std::max(greatest[k], end[k]);
      }
    }
  }
  return {{"bufferView", view},
          {"componentType", kFloat},
          {"count", 2 * lines.size()},
          {"type", "VEC3"},
          {"min", least},
          {"max", greatest}};
}

Json Property(const char* name, const char* type, const char* component, const char* description) {
  return {{"name", name},
          {"description", description},
          {"type", type},
          {"componentType", component},
          {"required", std::string(component) == "UINT32"}};
}

Json Schema() {
  Json properties;
  properties["posts"] =
      Property("Posts", "VEC2", "UINT32", "The DEM's posts at both ends: row * columns + column");
  properties["azimuths"] =
      Property("Azimuths", "VEC2", "UINT32",
               "Directions of sight, 64 bits, the low 32 first: bit i is set where the edge is on "
               "the skyline from i * 180 / 64 to (i + 1) * 180 / 64 degrees clockwise from north");
  properties["line_measure_m"] =
      Property("Line measure", "SCALAR", "FLOAT32",
               "The measure of the lines of sight that the DEM's edge is the skyline of, radians "
               "times metres; none of an edge that the DEM does not have");
  properties["skyline_drop_m"] =
      Property("Skyline drop", "SCALAR", "FLOAT32",
               "By how much the DEM's skyline would be lower without the edge, metres; none of an "
               "edge that the DEM does not have");
  for (const char* name : {"line_measure_m", "skyline_drop_m"})
    properties[name]["noData"] = kNoData;
  Json schema = {{"id", "farhorizon_horizon"}};
  schema["classes"][kClass] = {{"name", "Horizon edge"}, {"properties", properties}};
  return schema;
}

Json Table(const std::vector<HorizonLine>& lines, Binary& binary) {
  Json properties;
  const auto column = [&](const char* name, auto&& add) {
    const std::size_t begin = binary.bytes.size();
    for (const HorizonLine& line : lines) add(line);
    properties[name] = {{"values", binary.EndView(begin)}};
  };
  column("posts", [&](const HorizonLine& line) {
    for (const std::uint32_t post : line.posts) binary.Add(post);
  });
  column("azimuths", [&](const HorizonLine& line) {
    binary.Add(static_cast<std::uint32_t>(line.azimuths));
    binary.Add(static_cast<std::uint32_t>(line.azimuths >> 32U));
  });
  column("line_measure_m",
         [&](const HorizonLine& line) { binary.Add(line.line_measure_m.value_or(kNoData)); });
  column("skyline_drop_m",
         [&](const HorizonLine& line) { binary.Add(line.skyline_drop_m.value_or(kNoData)); });
  return {{"name", "Horizon edges"},
          {"class", kClass},
          {"count", lines.size()},
          {"properties", properties}};
}

Error BadGlb(const std::string& message) {
  return {ErrorCode::kUnsupportedData, "no horizon GLB of ours: " + message, "bad-glb"};
}

// The numbers of a view of `count` times four bytes.
class View {
 public:
  View(const Json& gltf, std::size_t index, std::span<const std::uint8_t> buffer,
       std::size_t count) {
    const Json& view = gltf.at("bufferViews").at(index);
    const auto offset = view.at("byteOffset").get<std::uint64_t>();
    const auto length = view.at("byteLength").get<std::uint64_t>();
    fits_ = offset % kAlignment == 0 && offset <= buffer.size() &&
            length <= buffer.size() - offset && length == kNumberBytes * count;
    if (fits_) bytes_ = buffer.subspan(offset, length);
  }

  [[nodiscard]] bool fits() const { return fits_; }
  [[nodiscard]] std::uint32_t Number(std::size_t i) const {
    std::uint32_t number = 0;
    for (std::size_t k = 0; k < kNumberBytes; ++k) {
      number |= std::uint32_t{bytes_[kNumberBytes * i + k]} << (8 * k);
    }
    return number;
  }
  [[nodiscard]] float Float(std::size_t i) const { return std::bit_cast<float>(Number(i)); }

 private:
  std::span<const std::uint8_t> bytes_;
  bool fits_ = false;
};

std::optional<float> Measure(float stored) {
  return stored == kNoData ? std::nullopt : std::optional<float>(stored);
}

// Puts the table's rows into the lines; false where a column does not fit.
bool ReadTable(const Json& gltf, std::span<const std::uint8_t> buffer,
               std::vector<HorizonLine>& lines) {
  const Json& table = gltf.at("extensions").at(kMetadata).at("propertyTables").at(0);
  if (table.at("count").get<std::size_t>() != lines.size()) return false;
  const auto column = [&](const char* name, std::size_t width) {
    const auto index = table.at("properties").at(name).at("values").get<std::size_t>();
    return View(gltf, index, buffer, width * lines.size());
  };
  const View posts = column("posts", 2);
  const View azimuths = column("azimuths", 2);
  const View measures = column("line_measure_m", 1);
  const View drops = column("skyline_drop_m", 1);
  if (!posts.fits() || !azimuths.fits() || !measures.fits() || !drops.fits()) return false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].posts = {posts.Number(2 * i), posts.Number(2 * i + 1)};
    lines[i].azimuths = azimuths.Number(2 * i) | AzimuthMask{azimuths.Number(2 * i + 1)} << 32U;
    lines[i].line_measure_m = Measure(measures.Float(i));
    lines[i].skyline_drop_m = Measure(drops.Float(i));
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> WriteHorizonGlb(const std::vector<HorizonLine>& lines,
                                          const QuantizationLattice& lattice) {
  Check(!lines.empty(), "a level has an outline, which has some of its skyline");
  Binary binary;
  for (const HorizonLine& line : lines) {
    for (const std::array<float, 3>& end : line.ends) {
      for (const float x : end) binary.Add(x);
    }
  }
  Json accessors = Json::array({PositionAccessor(lines, binary.EndView(0, kArrayBuffer))});
  Json primitive = {{"attributes", {{"POSITION", 0}}}, {"mode", kLines}, {"material", 0}};
  Json used = Json::array({kUnlit});
  Json gltf;
  gltf["asset"] = {{"version", "2.0"}, {"generator", "farhorizon"}};
  if (lines.size() <= kMostFeatures) {
    const std::size_t begin = binary.bytes.size();
    for (std::size_t i = 0; i < 2 * lines.size(); ++i) binary.Add(static_cast<float>(i / 2));
    accessors.push_back({{"bufferView", binary.EndView(begin, kArrayBuffer)},
                         {"componentType", kFloat},
                         {"count", 2 * lines.size()},
                         {"type", "SCALAR"}});
    primitive["attributes"]["_FEATURE_ID_0"] = 1;
    primitive["extensions"][kFeatures] = {
        {"featureIds",
         Json::array({{{"featureCount", lines.size()}, {"attribute", 0}, {"propertyTable", 0}}})}};
    used.push_back(kFeatures);
    used.push_back(kMetadata);
    gltf["extensions"][kMetadata] = {{"schema", Schema()},
                                     {"propertyTables", Json::array({Table(lines, binary)})}};
  }
  gltf["extensionsUsed"] = used;
  gltf["scene"] = 0;
  gltf["scenes"] = Json::array({{{"nodes", {0}}}});
  gltf["nodes"] = Json::array({{{"mesh", 0}, {"matrix", GltfMatrix(lattice)}}});
  gltf["meshes"] = Json::array({{{"primitives", Json::array({primitive})}}});
  Json material = {
      {"name", "horizon edge"},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {1, 0.25, 0, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}};
  material["extensions"][kUnlit] = Json::object();
  gltf["materials"] = Json::array({material});
  gltf["accessors"] = accessors;
  gltf["bufferViews"] = binary.views;
  gltf["buffers"] = Json::array({{{"byteLength", binary.bytes.size()}}});
  return JoinGlb(gltf.dump(), binary.bytes, kAlignment);
}

Result<HorizonGlbContents> ReadHorizonGlb(const std::vector<std::uint8_t>& bytes) {
  Result<GlbChunks> chunks = SplitGlb(bytes);
  if (!chunks) return BadGlb(chunks.error().message);
  try {
    const Json gltf = Json::parse(chunks->json.begin(), chunks->json.end());
    const Json& primitive = gltf.at("meshes").at(0).at("primitives").at(0);
    if (primitive.at("mode") != kLines) return BadGlb("it has no lines");
    const Json& position =
        gltf.at("accessors").at(primitive.at("attributes").at("POSITION").get<std::size_t>());
    const auto ends = position.at("count").get<std::size_t>();
    if (ends % 2 != 0 || ends > chunks->bin.size()) return BadGlb("it has half a line");
    const View numbers(gltf, position.at("bufferView").get<std::size_t>(), chunks->bin, 3 * ends);
    if (!numbers.fits()) return BadGlb("its positions are no view of the buffer");
    HorizonGlbContents contents;
    contents.matrix = gltf.at("nodes").at(0).at("matrix").get<std::array<double, 16>>();
    const auto least = position.at("min").get<std::array<float, 3>>();
    const auto greatest = position.at("max").get<std::array<float, 3>>();
    contents.lines.resize(ends / 2);
    contents.in_box = true;
    for (std::size_t i = 0; i < ends; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const float x = numbers.Float(3 * i + k);
        contents.lines[i / 2].ends[i % 2][k] = x;
        contents.in_box = contents.in_box && x >= least[k] && x <= greatest[k];
      }
    }
    contents.has_table = gltf.contains("extensions");
    if (contents.has_table && !ReadTable(gltf, chunks->bin, contents.lines)) {
      return BadGlb("its table does not have a row for each line");
    }
    return contents;
  } catch (const nlohmann::json::exception& failure) {
    return BadGlb(failure.what());
  }
}

}  // namespace farhorizon
