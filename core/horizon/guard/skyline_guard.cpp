#include "core/horizon/guard/skyline_guard.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/horizon/guard/below_ground.h"
#include "core/horizon/guard/superlevel_occluders.h"
#include "core/terrain/height_range.h"

namespace farhorizon {

SkylineGuard::SkylineGuard(const Terrain& terrain, const Horizon& horizon)
    : terrain_(&terrain),
      hulls_(&horizon.hulls),
      scale_(FinerHeights::Centred(HeightRangeOf(terrain.dem()))),
      occluders_(terrain.dem().columns, terrain.dem().rows) {
  std::vector<std::int32_t> heights;
  for (const HorizonEdge& h : horizon.edges) {
    heights.push_back(terrain.Point(h.edge.a).z);
    occluders_.Insert(
        {scale_.Scale(terrain.Point(h.edge.a)), scale_.Scale(terrain.Point(h.edge.b))});
  }
  for (const Segment& occluder : SuperlevelOccluders(terrain, std::move(heights))) {
    occluders_.Insert({scale_.Scale(occluder.a), scale_.Scale(occluder.b)});
  }
}

bool SkylineGuard::IsOccluded(VertexId p, VertexId q, std::int32_t steps_lower) const {
  const Point3i at_p = terrain_->Point(p);
  const Point3i at_q = terrain_->Point(q);
  // Whole quanta only, rounded towards the safe side: what hides the higher hides the lower.
  const std::int32_t whole = steps_lower >> scale_.bits;
  if (hulls_->Occludes(p, q, std::max(at_p.z, at_q.z) - whole)) return true;
  if (GroundCovers(*terrain_, *hulls_, scale_, p, q, steps_lower)) return true;
  const Segment segment = Lowered({scale_.Scale(at_p), scale_.Scale(at_q)}, steps_lower);
  return !occluders_.FindLineOfSight({.segment = segment, .ties = Ties::kBlock}).witness;
}

}  // namespace farhorizon
