#include "core/horizon/occluded_edges.h"

#include <algorithm>

#include "core/geometry/plan.h"
#include "core/horizon/visibility/occluder_set.h"

namespace farhorizon {

namespace {

// True where a face beside the edge bends: an edge between coplanar faces is no horizon edge.
bool IsCrease(const Terrain& terrain, Edge edge, const Terrain::Faces& faces) {
  return !faces.left || !faces.right ||
         RidgeSign(terrain.Point(edge.a), terrain.Point(edge.b), terrain.Point(*faces.left),
                   terrain.Point(*faces.right)) != 0;
}

}  // namespace

std::int64_t CountOccluded(const Terrain& terrain, const std::vector<Edge>& edges) {
  if (edges.empty()) return 0;
  const auto segment_of = [&terrain](Edge e) {
    return Segment{terrain.Point(e.a), terrain.Point(e.b)};
  };
  const std::vector<Edge> all = terrain.Edges();
  OccluderSet ground(terrain.dem().columns, terrain.dem().rows);
  for (const Edge e : all) ground.Insert(segment_of(e));
  return std::count_if(edges.begin(), edges.end(), [&](Edge edge) {
    const auto at = std::lower_bound(all.begin(), all.end(), edge);
    if (at == all.end() || *at != edge || !IsCrease(terrain, edge, terrain.FacesOf(edge))) {
      return true;
    }
    const auto own = static_cast<OccluderId>(at - all.begin());
    return !ground.FindLineOfSight({.segment = segment_of(edge), .except = own}).witness;
  });
}

}  // namespace farhorizon
