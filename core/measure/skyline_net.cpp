#include "core/measure/skyline_net.h"

#include <algorithm>

#include "core/measure/in_hull.h"

namespace farhorizon {

SkylineNet SkylineNetOf(const Terrain& terrain, const Horizon& horizon) {
  const Dem& dem = terrain.dem();
  std::vector<VertexId> posts;
  posts.reserve(2 * horizon.edges.size());
  for (const HorizonEdge& h : horizon.edges) {
    posts.push_back(h.edge.a);
    posts.push_back(h.edge.b);
  }
  std::sort(posts.begin(), posts.end());
  posts.erase(std::unique(posts.begin(), posts.end()), posts.end());
  SkylineNet net;
  net.points.reserve(posts.size());
  for (const VertexId v : posts) {
    net.points.push_back(
        {static_cast<double>(dem.Column(v)), static_cast<double>(dem.Row(v)), dem.HeightM(v)});
  }
  const auto index = [&posts](VertexId v) {
    return static_cast<std::int32_t>(std::lower_bound(posts.begin(), posts.end(), v) -
                                     posts.begin());
  };
  net.segments.reserve(horizon.edges.size());
  for (const HorizonEdge& h : horizon.edges) {
    const Terrain::Faces faces = terrain.FacesOf(h.edge);
    net.segments.push_back({index(h.edge.a), index(h.edge.b), !faces.left || !faces.right});
  }
  return net;
}

SkylineNet SkylineNetOf(const Dem& dem, const HullMergeTree& hulls, const GridMesh& mesh,
                        const MeshSides& sides, double sunk_m) {
  SkylineNet net;
  net.points = mesh.points;
  for (const MeshSide& side : sides.sides) {
    if (!IsRidgeOrOutline(mesh, side)) continue;
    if (!side.IsOutline() && IsInHull(dem, hulls, net.Point(side.a), net.Point(side.b), sunk_m)) {
      continue;
    }
    net.segments.push_back({side.a, side.b, side.IsOutline()});
  }
  return net;
}

}  // namespace farhorizon
