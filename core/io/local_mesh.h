#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/geo/frames.h"

namespace farhorizon {

/// A direction in the local frame: east, north, up; of length 1.
using UnitNormal = std::array<double, 3>;

/// Triangles by their vertices, counter-clockwise from above.
///
/// positions: in the local frame, metres. posts: for each vertex the number of the DEM's post that
/// the vertex stands for. normals: for each vertex, of the surface that the mesh stands for.
struct LocalMesh {
  std::vector<Enu> positions;
  std::vector<std::uint32_t> posts;
  std::vector<UnitNormal> normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Pairs (post, vertex) of all vertices, rising.
std::vector<std::pair<std::uint32_t, std::uint32_t>> VerticesByPost(const LocalMesh& mesh);

/// The normal of triangle abc, counter-clockwise; its length is twice the triangle's area.
std::array<double, 3> FaceNormal(const Enu& a, const Enu& b, const Enu& c);

}  // namespace farhorizon
