// Accessors over views over buffers, each offset and length checked against what holds it. Buffers
// and views are loaded when they are first needed: textures never are.
#include "core/io/mesh_files/gltf_buffers.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/io/file.h"
#include "core/io/gltf_numbers.h"
#include "core/io/mesh_files/beside_file.h"
#include "core/io/mesh_files/meshopt_view.h"

namespace farhorizon {

namespace {

constexpr char kMeshopt[] = "EXT_meshopt_compression";

// The type of a componentType of glTF's accessors.
std::optional<ScalarType> TypeOf(std::uint64_t component_type) {
  switch (component_type) {
    case gltf::kByte:
      return ScalarType::kInt8;
    case gltf::kUnsignedByte:
      return ScalarType::kUint8;
    case gltf::kShort:
      return ScalarType::kInt16;
    case gltf::kUnsignedShort:
      return ScalarType::kUint16;
    case gltf::kUnsignedInt:
      return ScalarType::kUint32;
    case gltf::kFloat:
      return ScalarType::kFloat;
    default:
      return std::nullopt;
  }
}

// The number that 1 stands for in a normalized accessor.
double GreatestOf(ScalarType type) {
  switch (type) {
    case ScalarType::kInt8:
      return INT8_MAX;
    case ScalarType::kUint8:
      return UINT8_MAX;
    case ScalarType::kInt16:
      return INT16_MAX;
    case ScalarType::kUint16:
      return UINT16_MAX;
    default:
      return 1;
  }
}

}  // namespace

Status GltfBuffers::Allocate(std::uint64_t bytes) {
  if (bytes > limits_.max_bytes - allocated_) {
    return Error{ErrorCode::kResourceExhausted,
                 "its buffers hold more than the " + std::to_string(limits_.max_bytes) +
                     " bytes that are read",
                 "mesh-too-large"};
  }
  allocated_ += bytes;
  return Ok{};
}

Result<std::span<const std::uint8_t>> GltfBuffers::BufferOf(std::uint64_t index) {
  const MeshJson& buffer = json_->at("buffers").at(index);
  const MeshJson* uri = Member(buffer, "uri");
  if (uri == nullptr) {
    if (index == 0 && !bin_.empty()) return bin_;
    return BadMeshFile("buffer " + std::to_string(index) + " has no bytes");
  }
  if (const auto loaded = buffers_.find(index); loaded != buffers_.end()) {
    return std::span<const std::uint8_t>(loaded->second);
  }
  const auto& name = uri->get_ref<const std::string&>();
  if (Status fits = Allocate(CountIn(buffer.at("byteLength"))); !fits) {
    return std::move(fits.error());
  }
  std::vector<std::uint8_t> bytes;
  if (name.starts_with("data:")) {
    std::optional<std::vector<std::uint8_t>> data = BytesOfDataUri(name);
    if (!data) return BadMeshFile("a data: address is not sound base64");
    bytes = *std::move(data);
  } else {
    Result<std::filesystem::path> path = PathBeside(folder_, name);
    if (!path) return std::move(path.error());
    Result<std::string> text = ReadFile(*path, limits_.max_bytes);
    if (!text) return std::move(text.error());
    bytes.assign(text->begin(), text->end());
  }
  return std::span<const std::uint8_t>(buffers_.emplace(index, std::move(bytes)).first->second);
}

Result<std::span<const std::uint8_t>> GltfBuffers::Piece(std::uint64_t buffer, std::uint64_t offset,
                                                         std::uint64_t length) {
  Result<std::span<const std::uint8_t>> bytes = BufferOf(buffer);
  if (!bytes) return std::move(bytes.error());
  if (offset > bytes->size() || length > bytes->size() - offset) {
    return BadMeshFile("a view reaches beyond buffer " + std::to_string(buffer) + ", which has " +
                       std::to_string(bytes->size()) + " bytes");
  }
  return bytes->subspan(offset, length);
}

Result<GltfBuffers::View> GltfBuffers::Decompressed(std::uint64_t index,
                                                    const MeshJson& extension) {
  MeshoptView view;
  view.stride = CountIn(extension.at("byteStride"));
  view.count = CountIn(extension.at("count"));
  view.mode = extension.at("mode").get_ref<const std::string&>();
  view.filter = "NONE";
  if (const MeshJson* filter = Member(extension, "filter")) {
    view.filter = filter->get_ref<const std::string&>();
  }
  if (const auto known = decompressed_.find(index); known != decompressed_.end()) {
    return View{known->second, view.stride};
  }
  Result<std::span<const std::uint8_t>> bytes =
      Piece(CountIn(extension.at("buffer")), CountOr(extension, "byteOffset", 0),
            CountIn(extension.at("byteLength")));
  if (!bytes) return std::move(bytes.error());
  // Indices and corners are not more than three a triangle; strides are at most 256.
  if (view.stride > 256 || view.count > 3 * limits_.max_triangles + limits_.max_points) {
    return Error{ErrorCode::kResourceExhausted, "a compressed view is too long", "mesh-too-large"};
  }
  if (Status fits = Allocate(view.stride * view.count); !fits) return std::move(fits.error());
  Result<std::vector<std::uint8_t>> decoded = DecodeMeshopt(*bytes, view);
  if (!decoded) return std::move(decoded.error());
  return View{decompressed_.emplace(index, *std::move(decoded)).first->second, view.stride};
}

Result<GltfBuffers::View> GltfBuffers::ViewOf(std::uint64_t index) {
  const MeshJson& view = json_->at("bufferViews").at(index);
  if (const MeshJson* extensions = Member(view, "extensions")) {
    if (const MeshJson* meshopt = Member(*extensions, kMeshopt)) {
      return Decompressed(index, *meshopt);
    }
  }
  Result<std::span<const std::uint8_t>> bytes = Piece(
      CountIn(view.at("buffer")), CountOr(view, "byteOffset", 0), CountIn(view.at("byteLength")));
  if (!bytes) return std::move(bytes.error());
  return View{*bytes, CountOr(view, "byteStride", 0)};
}

Result<GltfBuffers::Elements> GltfBuffers::ElementsOf(const MeshJson& accessor,
                                                      std::size_t components) {
  if (accessor.contains("sparse")) return BadMeshFile("sparse accessors are not read");
  Elements elements;
  elements.count = CountIn(accessor.at("count"));
  if (elements.count == 0) return elements;
  const MeshJson* view_index = Member(accessor, "bufferView");
  if (view_index == nullptr) return BadMeshFile("an accessor of positions or indices has no view");
  Result<View> view = ViewOf(CountIn(*view_index));
  if (!view) return std::move(view.error());
  const std::optional<ScalarType> type = TypeOf(CountIn(accessor.at("componentType")));
  if (!type) return BadMeshFile("an accessor has an unknown componentType");
  elements.type = *type;
  const std::uint64_t bytes = BytesOf(*type) * components;
  elements.stride = view->stride == 0 ? bytes : view->stride;
  const std::uint64_t offset = CountOr(accessor, "byteOffset", 0);
  const std::uint64_t size = view->bytes.size();
  if (offset > size || bytes > size - offset ||
      elements.count - 1 > (size - offset - bytes) / elements.stride) {
    return BadMeshFile("an accessor of " + std::to_string(elements.count) +
                       " elements reaches beyond its view");
  }
  elements.bytes = view->bytes.subspan(offset);
  return elements;
}

Result<std::vector<FilePoint>> GltfBuffers::Points(std::uint64_t index) {
  const MeshJson& accessor = json_->at("accessors").at(index);
  if (accessor.at("type") != "VEC3") return BadMeshFile("positions are no VEC3");
  Result<Elements> elements = ElementsOf(accessor, 3);
  if (!elements) return std::move(elements.error());
  if (Status few = CheckCounts(elements->count, 0, limits_); !few) return std::move(few.error());
  const bool normalized = accessor.value("normalized", false);
  const double unit = normalized ? GreatestOf(elements->type) : 1;
  std::vector<FilePoint> points(elements->count);
  for (std::uint64_t i = 0; i < elements->count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint8_t* at =
          elements->bytes.data() + i * elements->stride + k * BytesOf(elements->type);
      const double stored = ScalarAt(at, elements->type) / unit;
      points[i][k] = normalized ? std::max(stored, -1.0) : stored;
    }
  }
  return points;
}

Result<std::vector<std::uint32_t>> GltfBuffers::Indices(std::uint64_t index) {
  const MeshJson& accessor = json_->at("accessors").at(index);
  Result<Elements> elements = ElementsOf(accessor, 1);
  if (!elements) return std::move(elements.error());
  if (Status few = CheckCounts(0, elements->count / 3, limits_); !few) {
    return std::move(few.error());
  }
  if (elements->count > 0 && elements->type != ScalarType::kUint8 &&
      elements->type != ScalarType::kUint16 && elements->type != ScalarType::kUint32) {
    return BadMeshFile("indices are no unsigned numbers");
  }
  std::vector<std::uint32_t> indices(elements->count);
  for (std::uint64_t i = 0; i < elements->count; ++i) {
    indices[i] = static_cast<std::uint32_t>(
        ScalarAt(elements->bytes.data() + i * elements->stride, elements->type));
  }
  return indices;
}

}  // namespace farhorizon
