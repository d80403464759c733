// OBJ line by line. A corner of a face is `v`, `v/vt`, `v//vn` or `v/vt/vn`; v counts from 1, or
// backwards from the last point so far where it is negative. A line that ends with a backslash goes
// on in the next one.
#include "core/io/mesh_files/obj_file.h"

#include <string>
#include <utility>

#include "core/io/mesh_files/line_reader.h"

namespace farhorizon {

namespace {

Error BadLine(std::int64_t line, const std::string& what) {
  return BadMeshFile("line " + std::to_string(line) + " of the OBJ: " + what);
}

Status AddPoint(std::string_view rest, std::int64_t line, FileMesh& mesh) {
  FilePoint p{};
  for (double& x : p) {
    const std::optional<double> number = NumberOf(TakeWord(rest));
    if (!number) return BadLine(line, "a point has three numbers");
    x = *number;
  }
  mesh.points.push_back(p);
  return Ok{};
}

Status AddFace(std::string_view rest, std::int64_t line, std::vector<std::uint32_t>& corners,
               FileMesh& mesh) {
  corners.clear();
  for (std::string_view word = TakeWord(rest); !word.empty(); word = TakeWord(rest)) {
    const std::optional<std::int64_t> named = WholeNumberOf(word.substr(0, word.find('/')));
    const auto count = static_cast<std::int64_t>(mesh.points.size());
    const std::int64_t index = !named ? -1 : *named > 0 ? *named - 1 : count + *named;
    if (!named || *named == 0 || index < 0 || index > std::int64_t{UINT32_MAX}) {
      return BadLine(line, "a corner of a face names no point");
    }
    corners.push_back(static_cast<std::uint32_t>(index));
  }
  if (corners.size() < 3) return BadLine(line, "a face has fewer than three corners");
  AddPolygon(corners, mesh);
  return Ok{};
}

}  // namespace

Result<FileMesh> ReadObj(std::string_view text, const MeshLimits& limits) {
  FileMesh mesh;
  LineReader lines(text);
  std::vector<std::uint32_t> corners;
  std::string joined;
  for (std::string_view line; lines.Next(line);) {
    if (line.ends_with('\\')) {
      joined.clear();
      while (line.ends_with('\\')) {
        joined.append(line.substr(0, line.size() - 1)).append(" ");
        if (!lines.Next(line)) line = {};
      }
      line = joined.append(line);
    }
    const std::string_view keyword = TakeWord(line);
    Status read = keyword == "v"   ? AddPoint(line, lines.line(), mesh)
                  : keyword == "f" ? AddFace(line, lines.line(), corners, mesh)
                                   : Status(Ok{});
    if (!read) return std::move(read.error());
    if (Status few = CheckCounts(mesh.points.size(), mesh.triangles.size(), limits); !few) {
      return std::move(few.error());
    }
  }
  return mesh;
}

}  // namespace farhorizon
