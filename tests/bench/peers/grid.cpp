#include "grid.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>

namespace farhorizon::peers {

namespace {

template <typename T>
void Read(std::istream& file, T* values, std::size_t count, const std::string& path) {
  file.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
  if (!file) Fail(path + ": ends too early, or cannot be read");
}

template <typename T>
void Write(std::ostream& file, const T* values, std::size_t count) {
  file.write(reinterpret_cast<const char*>(values),
             static_cast<std::streamsize>(count * sizeof(T)));
}

/// Both files begin with two counts.
std::array<std::int32_t, 2> ReadCounts(std::istream& file, const std::string& path) {
  std::array<std::int32_t, 2> counts{};
  Read(file, counts.data(), counts.size(), path);
  if (counts[0] < 0 || counts[1] < 0) Fail(path + ": a negative count: not a file of this folder");
  return counts;
}

}  // namespace

bool Grid::Has(std::size_t post) const { return !std::isnan(heights[post]); }

Point Grid::PointAt(std::size_t post) const {
  const auto width = static_cast<std::size_t>(columns);
  return {static_cast<double>(post % width), static_cast<double>(post / width), heights[post]};
}

Mesh FullMesh(const Grid& grid) {
  Mesh mesh;
  for (std::size_t post = 0; post < grid.heights.size(); ++post)
    mesh.vertices.push_back(grid.PointAt(post));
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    if (!grid.Has(a) || !grid.Has(b) || !grid.Has(c)) return;
    mesh.triangles.push_back(
        {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
  };
  for (std::int32_t row = 0; row + 1 < grid.rows; ++row) {
    for (std::int32_t column = 0; column + 1 < grid.columns; ++column) {
      //  a - b
      //  | \ |
      //  d - c
      const std::size_t a = grid.At(column, row), b = a + 1;
      const std::size_t d = grid.At(column, row + 1), c = d + 1;
      if (grid.Has(a) && grid.Has(c)) {
        add(a, b, c);
        add(a, c, d);
      } else {
        add(a, b, d);
        add(b, c, d);
      }
    }
  }
  return mesh;
}

Grid ReadGrid(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const auto [columns, rows] = ReadCounts(file, path);
  Grid grid{columns, rows, {}};
  grid.heights.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  Read(file, grid.heights.data(), grid.heights.size(), path);
  return grid;
}

void WriteGrid(const Grid& grid, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  Write(file, &grid.columns, 1);
  Write(file, &grid.rows, 1);
  Write(file, grid.heights.data(), grid.heights.size());
  if (!file.flush()) Fail(path + ": cannot be written");
}

Mesh ReadMesh(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const auto [vertices, triangles] = ReadCounts(file, path);
  std::vector<std::array<float, 3>> points(static_cast<std::size_t>(vertices));
  Mesh mesh;
  mesh.triangles.resize(static_cast<std::size_t>(triangles));
  Read(file, points.data(), points.size(), path);
  Read(file, mesh.triangles.data(), mesh.triangles.size(), path);
  for (const auto& p : points) mesh.vertices.push_back({p[0], p[1], p[2]});
  for (const auto& triangle : mesh.triangles) {
    for (const std::int32_t vertex : triangle)
      if (vertex < 0 || vertex >= vertices)
        Fail(path + ": a triangle of a vertex that is not there");
  }
  return mesh;
}

void WriteMesh(const Mesh& mesh, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  const std::array<std::int32_t, 2> counts = {static_cast<std::int32_t>(mesh.vertices.size()),
                                              static_cast<std::int32_t>(mesh.triangles.size())};
  Write(file, counts.data(), counts.size());
  for (const Point& p : mesh.vertices) {
    const std::array<float, 3> point = {static_cast<float>(p.x), static_cast<float>(p.y),
                                        static_cast<float>(p.z)};
    Write(file, point.data(), point.size());
  }
  Write(file, mesh.triangles.data(), mesh.triangles.size());
  if (!file.flush()) Fail(path + ": cannot be written");
}

void Fail(const std::string& message) {
  std::cerr << message << '\n';
  std::exit(1);
}

}  // namespace farhorizon::peers
