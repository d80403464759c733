// A DEM and a mesh over it as the programs of this folder hand them on: in columns, rows and
// metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace farhorizon::peers {

/// A point over the grid: column, row (0, 0 is the first post), height in metres.
struct Point {
  double x, y, z;
};

/// The heights of a DEM's posts, row by row, metres; NaN where a post is missing.
///
/// File: int32 columns, int32 rows, float32 heights, in the machine's byte order.
struct Grid {
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  std::vector<float> heights;

  [[nodiscard]] std::size_t At(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] bool Has(std::size_t post) const;
  [[nodiscard]] Point PointAt(std::size_t post) const;
};

/// The triangles of any surface over the grid.
///
/// File: int32 vertices, int32 triangles; float32 column, row, metres a vertex; int32 a, b, c a
/// triangle. The winding is not prescribed: it differs from one tool to the next.
struct Mesh {
  std::vector<Point> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// The terrain of all posts of `grid`: each cell is split along the diagonal from (column, row) to
/// (column + 1, row + 1); a cell with one missing post keeps the triangle of its other three, a
/// cell with more has none. Vertices are numbered as posts, the missing ones too.
[[nodiscard]] Mesh FullMesh(const Grid& grid);

/// The files above. A file that cannot be read or written, or whose parts contradict each other,
/// ends the program with a message and exit status 1: nothing in this folder can go on without it.
[[nodiscard]] Grid ReadGrid(const std::string& path);
void WriteGrid(const Grid& grid, const std::string& path);
[[nodiscard]] Mesh ReadMesh(const std::string& path);
void WriteMesh(const Mesh& mesh, const std::string& path);

/// Says `message` on stderr and ends the program with exit status 1.
[[noreturn]] void Fail(const std::string& message);

}  // namespace farhorizon::peers
