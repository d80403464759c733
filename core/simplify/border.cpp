#include "core/simplify/border.h"

namespace farhorizon {
std::vector<bool> OutlinePosts(const Terrain& terrain) {
  std::vector<bool> outline(static_cast<std::size_t>(terrain.post_count()), false);
  for (const Edge& edge : terrain.Edges()) {
    const Terrain::Faces faces = terrain.FacesOf(edge);
    if (faces.left && faces.right) continue;
    outline[static_cast<std::size_t>(edge.a)] = true;
    outline[static_cast<std::size_t>(edge.b)] = true;
  }
  return outline;
}

}  // namespace farhorizon
