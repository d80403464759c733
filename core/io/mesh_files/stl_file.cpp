// Binary STL: 80 bytes of anything, the number of triangles, 50 bytes a triangle: a normal, three
// corners, two bytes of attributes. Its 80 bytes often begin with "solid", as text does, so that
// the size decides first.
#include "core/io/mesh_files/stl_file.h"

#include <string>
#include <utility>

#include "core/io/mesh_files/line_reader.h"
#include "core/io/mesh_files/stored_scalar.h"

namespace farhorizon {

namespace {

constexpr std::size_t kHeadBytes = 84;
constexpr std::size_t kTriangleBytes = 50;
constexpr std::size_t kCornersAt = 12;

void AddCorners(const std::array<FilePoint, 3>& corners, FileMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

Result<FileMesh> ReadBinary(const std::uint8_t* bytes, std::uint64_t count,
                            const MeshLimits& limits) {
  if (Status few = CheckCounts(3 * count, count, limits); !few) return std::move(few.error());
  FileMesh mesh;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint8_t* at = bytes + kHeadBytes + i * kTriangleBytes + kCornersAt;
    std::array<FilePoint, 3> corners{};
    for (FilePoint& p : corners) {
      for (double& x : p) {
        x = ScalarAt(at, ScalarType::kFloat);
        at += BytesOf(ScalarType::kFloat);
      }
    }
    AddCorners(corners, mesh);
  }
  return mesh;
}

Result<FileMesh> ReadText(std::string_view text, const MeshLimits& limits) {
  FileMesh mesh;
  LineReader lines(text);
  std::array<FilePoint, 3> corners{};
  std::size_t known = 0;
  const auto bad = [&](const char* what) {
    return BadMeshFile("line " + std::to_string(lines.line()) + " of the STL: " + what);
  };
  for (std::string_view line; lines.Next(line);) {
    const std::string_view keyword = TakeWord(line);
    if (keyword == "vertex") {
      if (known == corners.size()) return bad("a facet has more than three corners");
      for (double& x : corners[known]) {
        const std::optional<double> number = NumberOf(TakeWord(line));
        if (!number) return bad("a vertex has three numbers");
        x = *number;
      }
      ++known;
    } else if (keyword == "endfacet") {
      if (known != corners.size()) return bad("a facet has fewer than three corners");
      known = 0;
      AddCorners(corners, mesh);
      if (Status few = CheckCounts(mesh.points.size(), mesh.triangles.size(), limits); !few) {
        return std::move(few.error());
      }
    }
  }
  if (known != 0) return bad("it ends within a facet");
  return mesh;
}

}  // namespace

Result<FileMesh> ReadStl(std::string_view bytes, const MeshLimits& limits) {
  const auto* at = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const std::uint64_t count = bytes.size() < kHeadBytes ? 0 : Uint32At(at + kHeadBytes - 4);
  const bool fits =
      bytes.size() >= kHeadBytes && bytes.size() - kHeadBytes == count * kTriangleBytes;
  if (!fits && bytes.starts_with("solid")) return ReadText(bytes, limits);
  if (bytes.size() < kHeadBytes || bytes.size() - kHeadBytes < count * kTriangleBytes) {
    return BadMeshFile("the STL is cut short: " + std::to_string(count) +
                       " triangles do not fit in " + std::to_string(bytes.size()) + " bytes");
  }
  return ReadBinary(at, count, limits);
}

}  // namespace farhorizon
