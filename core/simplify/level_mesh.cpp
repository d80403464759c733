#include "core/simplify/level_mesh.h"

#include <algorithm>
#include <utility>

namespace farhorizon {

Lod LevelOf(const Workpiece& work, const std::vector<SidePosts::Height>& sides) {
  const HalfEdgeMesh& mesh = work.mesh;
  Lod lod;
  std::vector<std::pair<VertexId, double>> vertices;
  for (std::int32_t v = 0; v < mesh.vertices(); ++v) {
    if (!mesh.IsVertex(v)) continue;
    vertices.emplace_back(work.ground.PostAt(mesh.at(v)), work.rules.HeightM(mesh.at(v)));
  }
  std::sort(vertices.begin(), vertices.end());
  for (const auto& [post, height_m] : vertices) {
    lod.mesh.posts.push_back(post);
    lod.mesh.heights_m.push_back(height_m);
  }
  // A side's heights as computed from the side, not from there and back through this tile's floats.
  for (const SidePosts::Height& side : sides) {
    const auto at = std::lower_bound(lod.mesh.posts.begin(), lod.mesh.posts.end(), side.post);
    if (at == lod.mesh.posts.end() || *at != side.post) continue;
    lod.mesh.heights_m[static_cast<std::size_t>(at - lod.mesh.posts.begin())] = side.height_m;
  }
  for (std::int32_t h = 0; h < mesh.half_edges(); h += 3) {
    if (!mesh.Stands(h / 3)) continue;
    const auto post = [&](std::int32_t k) { return work.ground.PostAt(mesh.at(mesh.origin(k))); };
    lod.mesh.triangles.push_back({post(h), post(h + 2), post(h + 1)});
  }
  lod.kept = work.rules.KeptIn(mesh);
  lod.exact = !work.rules.allows_rises();
  return lod;
}

}  // namespace farhorizon
