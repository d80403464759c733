// Takes only what WriteHorizonGlb makes, and checks each offset and count: verification reads files
// of unknown origin.
#include "core/io/horizon_glb_reader.h"

#include <bit>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/io/glb_container.h"
#include "core/io/gltf_numbers.h"
#include "core/io/horizon_glb.h"

namespace farhorizon {

namespace {

using Json = nlohmann::json;

Error NoHorizonGlb(const std::string& message) {
  return {ErrorCode::kUnsupportedData, "no horizon GLB of ours: " + message, "bad-glb"};
}

// The numbers of a view of the buffer.
class View {
 public:
  // Requires, or fits() is false: the view has `rows` times `stride` bytes, within the buffer.
  View(const Json& gltf, const Json& index, std::span<const std::uint8_t> buffer, std::size_t rows,
       std::size_t stride) {
    const Json& view = gltf.at("bufferViews").at(index.get<std::size_t>());
    const auto offset = view.at("byteOffset").get<std::uint64_t>();
    const auto length = view.at("byteLength").get<std::uint64_t>();
    fits_ = offset % kHorizonGlbAlignment == 0 && offset <= buffer.size() &&
            length <= buffer.size() - offset && length % stride == 0 && length / stride == rows &&
            view.value("byteStride", stride) == stride;
    if (fits_) bytes_ = buffer.subspan(offset, length);
  }

  [[nodiscard]] bool fits() const { return fits_; }
  // The number of `width` bytes at a byte of the view.
  [[nodiscard]] std::uint64_t At(std::size_t byte, std::size_t width) const {
    std::uint64_t number = 0;
    for (std::size_t k = 0; k < width; ++k) {
      number |= std::uint64_t{bytes_[byte + k]} << (8 * k);
    }
    return number;
  }
  [[nodiscard]] float Float(std::size_t byte) const {
    return std::bit_cast<float>(static_cast<std::uint32_t>(At(byte, 4)));
  }

 private:
  std::span<const std::uint8_t> bytes_;
  bool fits_ = false;
};

std::optional<std::vector<HorizonGlbPoint>> ReadPoints(const Json& gltf, const Json& accessor,
                                                       std::span<const std::uint8_t> buffer) {
  const bool shorts = accessor.at("componentType") == gltf::kUnsignedShort;
  if (!shorts && accessor.at("componentType") != gltf::kFloat) return std::nullopt;
  const auto count = accessor.at("count").get<std::size_t>();
  const std::size_t stride = shorts ? 8 : 12;
  const View view(gltf, accessor.at("bufferView"), buffer, count, stride);
  if (!view.fits()) return std::nullopt;
  std::vector<HorizonGlbPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      points[i][k] = shorts ? static_cast<float>(view.At(i * stride + 2 * k, 2))
                            : view.Float(i * stride + 4 * k);
    }
  }
  return points;
}

std::optional<std::vector<std::size_t>> ReadIndices(const Json& gltf, const Json& accessor,
                                                    std::span<const std::uint8_t> buffer,
                                                    std::size_t points) {
  const std::size_t width = accessor.at("componentType") == gltf::kUnsignedShort ? 2 : 4;
  if (width == 4 && accessor.at("componentType") != gltf::kUnsignedInt) return std::nullopt;
  const auto count = accessor.at("count").get<std::size_t>();
  const View view(gltf, accessor.at("bufferView"), buffer, count, width);
  if (!view.fits() || count % 2 != 0) return std::nullopt;
  std::vector<std::size_t> indices(count);
  for (std::size_t i = 0; i < count; ++i) {
    indices[i] = view.At(i * width, width);
    if (indices[i] >= points) return std::nullopt;
  }
  return indices;
}

std::optional<float> Measure(float stored) {
  return stored == kUnsetMeasure ? std::nullopt : std::optional<float>(stored);
}

// The rows of the table, with the points of as many lines as each has; unset where a column does
// not fit, or the lines of a chain do not hang together.
std::optional<std::vector<LineChain>> ReadChains(const Json& gltf,
                                                 std::span<const std::uint8_t> buffer,
                                                 const std::vector<HorizonGlbPoint>& points,
                                                 const std::vector<std::size_t>& indices) {
  const Json& metadata = gltf.at("extensions").at("EXT_structural_metadata");
  const Json& table = metadata.at("propertyTables").at(0);
  const Json& schema = metadata.at("schema").at("classes").at(table.at("class").get<std::string>());
  const std::string type = schema.at("properties").at("edges").at("componentType");
  const std::size_t width = type == "UINT8" ? 1 : type == "UINT16" ? 2 : 4;
  const auto count = table.at("count").get<std::size_t>();
  const auto column = [&](const char* name, std::size_t stride) {
    return View(gltf, table.at("properties").at(name).at("values"), buffer, count, stride);
  };
  const View edges = column("edges", width);
  const View azimuths = column("azimuths", 8);
  const View measures = column("line_measure_m", 4);
  const View drops = column("skyline_drop_m", 4);
  if (!edges.fits() || !azimuths.fits() || !measures.fits() || !drops.fits()) return std::nullopt;
  std::vector<LineChain> chains(count);
  std::size_t next = 0;
  for (std::size_t i = 0; i < count; ++i) {
    LineChain& chain = chains[i];
    const std::uint64_t lines = edges.At(i * width, width);
    if (lines == 0 || lines > (indices.size() - next) / 2) return std::nullopt;
    chain.points.push_back(points[indices[next]]);
    for (std::size_t k = 0; k < lines; ++k, next += 2) {
      if (k > 0 && indices[next] != indices[next - 1]) return std::nullopt;
      chain.points.push_back(points[indices[next + 1]]);
    }
    chain.azimuths = azimuths.At(8 * i, 8);
    chain.line_measure_m = Measure(measures.Float(4 * i));
    chain.skyline_drop_m = Measure(drops.Float(4 * i));
  }
  return next == indices.size() ? std::optional(std::move(chains)) : std::nullopt;
}

bool IsInBox(const std::vector<HorizonGlbPoint>& points, const Json& accessor) {
  const auto least = accessor.at("min").get<HorizonGlbPoint>();
  const auto greatest = accessor.at("max").get<HorizonGlbPoint>();
  for (const HorizonGlbPoint& point : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (point[k] < least[k] || point[k] > greatest[k]) return false;
    }
  }
  return true;
}

}  // namespace

Result<HorizonGlbContents> ReadHorizonGlb(const std::vector<std::uint8_t>& bytes) {
  Result<GlbChunks> chunks = SplitGlb(bytes);
  if (!chunks) return NoHorizonGlb(chunks.error().message);
  try {
    const Json gltf = Json::parse(chunks->json.begin(), chunks->json.end());
    const Json& primitive = gltf.at("meshes").at(0).at("primitives").at(0);
    if (primitive.at("mode") != gltf::kLines) return NoHorizonGlb("it has no lines");
    const auto accessor = [&gltf](const Json& index) -> const Json& {
      return gltf.at("accessors").at(index.get<std::size_t>());
    };
    const Json& position = accessor(primitive.at("attributes").at("POSITION"));
    const auto points = ReadPoints(gltf, position, chunks->bin);
    if (!points) return NoHorizonGlb("its positions are no view of the buffer");
    const auto indices =
        ReadIndices(gltf, accessor(primitive.at("indices")), chunks->bin, points->size());
    if (!indices) return NoHorizonGlb("its indices are no pairs of its points");
    auto chains = ReadChains(gltf, chunks->bin, *points, *indices);
    if (!chains) return NoHorizonGlb("its table does not have a row for each chain of its lines");
    HorizonGlbContents contents;
    contents.chains = *std::move(chains);
    contents.matrix = gltf.at("nodes").at(0).at("matrix").get<std::array<double, 16>>();
    contents.in_box = IsInBox(*points, position);
    return contents;
  } catch (const nlohmann::json::exception& failure) {
    return NoHorizonGlb(failure.what());
  }
}

}  // namespace farhorizon
