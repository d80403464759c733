// PLY: a header that describes the elements (ply_header.h), then their values in that order. Each
// value takes at least a byte, so that a count beyond the file's size ends in an error before
// memory is used up.
#include "core/io/mesh_files/ply_file.h"

#include <cmath>
#include <string>
#include <utility>

#include "core/io/mesh_files/line_reader.h"
#include "core/io/mesh_files/ply_header.h"

namespace farhorizon {

namespace {

// The values of the body, one after the other.
class Values {
 public:
  Values(std::string_view body, PlyEncoding encoding) : rest_(body), encoding_(encoding) {}

  // nullopt at the end of the file, or where a word is no number.
  std::optional<double> Next(ScalarType type) {
    if (encoding_ == PlyEncoding::kText) return NumberOf(TakeWord(rest_));
    const std::size_t bytes = BytesOf(type);
    if (rest_.size() < bytes) return std::nullopt;
    const auto* at = reinterpret_cast<const std::uint8_t*>(rest_.data());
    rest_.remove_prefix(bytes);
    const bool little = encoding_ == PlyEncoding::kLittleEndian;
    return ScalarAt(at, type, little ? ByteOrder::kLittle : ByteOrder::kBig);
  }

 private:
  std::string_view rest_;
  PlyEncoding encoding_;
};

// The whole number from 0 to 2^32 - 1 that `value` is; nullopt where it is none.
std::optional<std::uint32_t> Whole(std::optional<double> value) {
  if (!value || !(*value >= 0 && *value <= double{UINT32_MAX}) || std::floor(*value) != *value) {
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(*value);
}

// A row of an element: single values by property, and the list that is asked for.
struct Row {
  std::vector<double> values;
  std::vector<std::uint32_t> list;
};

bool ReadRow(const PlyElement& element, const PlyProperty* wanted, Values& values, Row& row) {
  row.values.clear();
  row.list.clear();
  for (const PlyProperty& property : element.properties) {
    if (!property.count_type) {
      const std::optional<double> value = values.Next(property.type);
      if (!value) return false;
      row.values.push_back(*value);
      continue;
    }
    row.values.push_back(0);
    const std::optional<std::uint32_t> count = Whole(values.Next(*property.count_type));
    if (!count) return false;
    for (std::uint32_t i = 0; i < *count; ++i) {
      const std::optional<double> value = values.Next(property.type);
      if (!value) return false;
      if (&property != wanted) continue;
      const std::optional<std::uint32_t> index = Whole(value);
      if (!index) return false;
      row.list.push_back(*index);
    }
  }
  return true;
}

const PlyProperty* Find(const PlyElement& element, std::string_view name, bool list) {
  for (const PlyProperty& p : element.properties) {
    if (p.name == name && p.count_type.has_value() == list) return &p;
  }
  return nullptr;
}

// Reads the rows of one element into `mesh`.
Status ReadElement(const PlyElement& element, Values& values, const MeshLimits& limits,
                   FileMesh& mesh) {
  if (element.properties.empty()) return Ok{};
  std::array<std::size_t, 3> axes{};
  const bool vertices = element.name == "vertex";
  for (std::size_t k = 0; vertices && k < 3; ++k) {
    constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};
    const PlyProperty* axis = Find(element, kNames[k], false);
    if (axis == nullptr) return BadMeshFile("the vertices of the PLY have no x, y and z");
    axes[k] = static_cast<std::size_t>(axis - element.properties.data());
  }
  const PlyProperty* corners = nullptr;
  if (element.name == "face") {
    corners = Find(element, "vertex_indices", true);
    if (corners == nullptr) corners = Find(element, "vertex_index", true);
    if (corners == nullptr) return BadMeshFile("the faces of the PLY have no vertex_indices");
  }
  Row row;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    if (!ReadRow(element, corners, values, row)) {
      return BadMeshFile("the PLY's " + element.name + " " + std::to_string(i) + " of " +
                         std::to_string(element.count) +
                         ", counted from 0, is cut short or holds what it may not");
    }
    if (vertices) {
      mesh.points.push_back({row.values[axes[0]], row.values[axes[1]], row.values[axes[2]]});
    }
    AddPolygon(row.list, mesh);
    if (Status few = CheckCounts(mesh.points.size(), mesh.triangles.size(), limits); !few) {
      return few;
    }
  }
  return Ok{};
}

}  // namespace

Result<FileMesh> ReadPly(std::string_view bytes, const MeshLimits& limits) {
  Result<PlyHeader> header = ReadPlyHeader(bytes);
  if (!header) return std::move(header.error());
  FileMesh mesh;
  Values values(bytes.substr(header->body), header->encoding);
  for (const PlyElement& element : header->elements) {
    if (Status read = ReadElement(element, values, limits, mesh); !read) {
      return std::move(read.error());
    }
  }
  return mesh;
}

}  // namespace farhorizon
