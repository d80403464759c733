#include "core/pipeline/compare/level_summary.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace farhorizon {

std::vector<LevelSummary> SummarizeLevels(const std::vector<MeshComparison>& meshes) {
  std::map<int, std::vector<const MeshComparison*>> by_depth;
  for (const MeshComparison& mesh : meshes) {
    if (mesh.depth && !mesh.fault) by_depth[*mesh.depth].push_back(&mesh);
  }
  std::vector<LevelSummary> levels;
  for (const auto& [depth, tiles] : by_depth) {
    if (tiles.size() < 2) continue;
    LevelSummary level;
    level.depth = depth;
    level.tiles = static_cast<std::int64_t>(tiles.size());
    double posts = 0;
    double vertical = 0;  // sums of squares
    double facets = 0;
    double needles = 0;
    for (const MeshComparison* tile : tiles) {
      const MeshError& e = tile->error;
      const auto weight = static_cast<double>(tile->posts);
      level.triangles += tile->triangles;
      level.vertices += tile->vertices;
      level.vertical.max_m = std::max(level.vertical.max_m, e.vertical.max_m);
      level.silhouette_max_m = std::max(level.silhouette_max_m, e.silhouette.max_m);
      level.rim_m = std::max(level.rim_m, e.rim_m);
      posts += weight;
      vertical += weight * e.vertical.rms_m * e.vertical.rms_m;
      facets += weight * e.facet_angle_rms_deg * e.facet_angle_rms_deg;
      needles += static_cast<double>(tile->triangles) * e.needle_share;
    }
    level.vertical.rms_m = std::sqrt(vertical / posts);
    level.facet_angle_rms_deg = std::sqrt(facets / posts);
    level.needle_share = needles / static_cast<double>(level.triangles);
    levels.push_back(level);
  }
  return levels;
}

}  // namespace farhorizon
