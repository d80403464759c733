#include "core/horizon/hull_sweep.h"

namespace farhorizon {

Result<HullSweep> SweepHulls(const Terrain& terrain, const Watch&) {
  HullSweep sweep;
  for (const Edge edge : terrain.Edges()) {
    ++sweep.statistics.terrain_edges;
    const Terrain::Faces faces = terrain.FacesOf(edge);
    if (faces.left && faces.right &&
        Convexity(terrain.Point(edge.a), terrain.Point(edge.b), terrain.Point(*faces.left),
                  terrain.Point(*faces.right)) <= 0) {
      continue;
    }
    sweep.candidates.push_back(edge);
  }
  sweep.statistics.candidates = static_cast<std::int64_t>(sweep.candidates.size());
  sweep.hulls.covered_level.assign(static_cast<std::size_t>(terrain.post_count()), kNoHeight);
  sweep.hulls.cluster.assign(static_cast<std::size_t>(terrain.post_count()), -1);
  return sweep;
}

}  // namespace farhorizon
