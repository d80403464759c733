#include "core/simplify/level_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace farhorizon {

namespace {

double VerticalRms(const HalfEdgeMesh& mesh) {
  const PostSquares plain(mesh.ground());  // no slopes, no limit
  double sum = 0;
  for (std::int32_t h = 0; h < mesh.half_edges(); ++h) {
    if (!mesh.Stands(h / 3)) continue;
    const auto at = [&](std::int32_t k) { return mesh.at(mesh.origin(k)); };
    const std::int32_t next = HalfEdgeMesh::Next(h);
    if (h % 3 == 0) sum += static_cast<double>(plain.Of(at(h), at(h + 1), at(h + 2)));
    if (mesh.twin(h) == HalfEdgeMesh::kNone) {
      sum += static_cast<double>(plain.OfRim(at(h), at(next)));
    }
  }
  return std::sqrt(sum / mesh.vertices());
}

double SilhouetteRms(const SampledSkyline& skyline) {
  double sum = 0;
  std::int64_t lines = 0;
  for (std::int32_t line = 0; line < skyline.pencils().lines(); ++line) {
    if (!skyline.Counts(line)) continue;
    sum += static_cast<double>(skyline.Square(line, skyline.top(line)));
    ++lines;
  }
  return lines > 0 ? std::sqrt(sum / static_cast<double>(lines)) : 0;
}

}  // namespace

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
  lod.parts = work.rules.parts().depth();
  lod.vertical_rms_m = VerticalRms(mesh);
  lod.silhouette_rms_m = lod.exact ? 0 : SilhouetteRms(work.skyline);
  return lod;
}

}  // namespace farhorizon
