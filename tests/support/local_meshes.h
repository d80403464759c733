#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/io/local_mesh.h"

namespace farhorizon {

/// A hilly grid of columns x rows vertices, `cell_m` apart, centred on the origin; source = row *
/// columns + column; normals are the hills'. `hole(column, row)`: vertices that are left out, with
/// the triangles at them.
template <typename Hole>
LocalMesh HillyGrid(std::uint32_t columns, std::uint32_t rows, double cell_m, Hole hole) {
  LocalMesh mesh;
  std::vector<std::uint32_t> index(std::size_t{columns} * rows, UINT32_MAX);
  const auto id = [&](std::uint32_t c, std::uint32_t r) { return std::size_t{r} * columns + c; };
  std::vector<std::array<std::size_t, 3>> triangles;
  const auto add = [&](std::array<std::size_t, 3> t) {
    for (const std::size_t v : t) {
      if (hole(static_cast<std::uint32_t>(v % columns), static_cast<std::uint32_t>(v / columns))) {
        return;
      }
    }
    triangles.push_back(t);
  };
  for (std::uint32_t r = 0; r + 1 < rows; ++r) {
    for (std::uint32_t c = 0; c + 1 < columns; ++c) {
      add({id(c, r), id(c, r + 1), id(c + 1, r + 1)});
      add({id(c, r), id(c + 1, r + 1), id(c + 1, r)});
    }
  }
  for (const auto& t : triangles) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& v = index[t[k]];
      if (v == UINT32_MAX) {
        v = static_cast<std::uint32_t>(mesh.positions.size());
        const double c = static_cast<double>(t[k] % columns);
        const double r = static_cast<double>(t[k] / columns);
        mesh.positions.push_back(
            {(c - columns / 2.0) * cell_m, (rows / 2.0 - r) * cell_m,
             400 + 90.3 * std::sin(c / 3.1) + 70.7 * std::cos(r / 4.3 + c / 9)});
        mesh.posts.push_back(static_cast<std::uint32_t>(t[k]));
        const double east = -90.3 / 3.1 * std::cos(c / 3.1) + 70.7 / 9 * std::sin(r / 4.3 + c / 9);
        const double north = -70.7 / 4.3 * std::sin(r / 4.3 + c / 9);
        const double up =
            std::max(cell_m, std::hypot(east, north) / 30);  // no steeper than is sound
        const double length = std::hypot(east, north, up);
        mesh.normals.push_back({east / length, north / length, up / length});
      }
      triangle[k] = v;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

inline LocalMesh HillyGrid(std::uint32_t columns, std::uint32_t rows, double cell_m) {
  return HillyGrid(columns, rows, cell_m, [](std::uint32_t, std::uint32_t) { return false; });
}

}  // namespace farhorizon
