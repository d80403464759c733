#include "core/terrain/border.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

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

bool RunsAlongOutline(const Terrain& terrain, Edge edge) {
  const Dem& dem = terrain.dem();
  const std::int32_t columns = dem.Column(edge.b) - dem.Column(edge.a);
  const std::int32_t rows = dem.Row(edge.b) - dem.Row(edge.a);
  const std::int32_t steps = std::gcd(columns, rows);
  const std::int32_t column_step = columns / steps;
  const std::int32_t row_step = rows / steps;
  if (std::max(std::abs(column_step), std::abs(row_step)) > 1) return false;
  int lefts = 0;
  int rights = 0;
  VertexId v = edge.a;
  for (std::int32_t i = 0; i < steps; ++i) {
    const VertexId next = v + row_step * dem.columns + column_step;
    // a < b, so v < next, and left of the step is left of the whole segment.
    const Terrain::Faces faces = terrain.FacesOf(MakeEdge(v, next));
    lefts += static_cast<int>(faces.left.has_value());
    rights += static_cast<int>(faces.right.has_value());
    v = next;
  }
  return (lefts == steps && rights == 0) || (lefts == 0 && rights == steps);
}

}  // namespace farhorizon
