#pragma once

#include <algorithm>
#include <array>
#include <vector>

namespace farhorizon {

using TrianglePoints = std::array<std::array<double, 3>, 3>;

/// The triangles of a mesh by their points, whatever the order of points and triangles, each
/// beginning at its least point so that its winding stays.
template <typename Mesh>
std::vector<TrianglePoints> TrianglesByPoint(const Mesh& mesh) {
  std::vector<TrianglePoints> triangles;
  for (const auto& t : mesh.triangles) {
    TrianglePoints points{mesh.points.at(t[0]), mesh.points.at(t[1]), mesh.points.at(t[2])};
    std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
    triangles.push_back(points);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace farhorizon
