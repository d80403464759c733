#include "core/io/local_mesh.h"

#include <algorithm>

namespace farhorizon {

std::vector<std::pair<std::uint32_t, std::uint32_t>> VerticesByPost(const LocalMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_post;
  by_post.reserve(mesh.posts.size());
  for (std::uint32_t i = 0; i < mesh.posts.size(); ++i) by_post.emplace_back(mesh.posts[i], i);
  std::sort(by_post.begin(), by_post.end());
  return by_post;
}

std::array<double, 3> FaceNormal(const Enu& a, const Enu& b, const Enu& c) {
  const std::array<double, 3> u = {b.east - a.east, b.north - a.north, b.up - a.up};
  const std::array<double, 3> v = {c.east - a.east, c.north - a.north, c.up - a.up};
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

}  // namespace farhorizon
