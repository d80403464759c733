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

bool SkylineGuard::IsSurelyOccluded(const Segment& scaled) const {
  const auto post = [this](const Point3i& point) {
    return point.y * terrain_->dem().columns + point.x;
  };
  // Whole quanta only, rounded towards the safe side: what hides the higher hides the lower.
  const std::int32_t most = std::max(scaled.a.z, scaled.b.z);
  const std::int32_t height = scale_.zero - (-most >> scale_.bits);
  return hulls_->Occludes(post(scaled.a), post(scaled.b), height) ||
         GroundCovers(*terrain_, *hulls_, scale_, scaled);
}

bool SkylineGuard::IsOccluded(const Segment& scaled, std::vector<OccluderId>& likely) const {
  if (IsSurelyOccluded(scaled)) return true;
  Visibility found = occluders_.FindLineOfSight({.segment = scaled,
                                                 .ties = Ties::kBlock,
                                                 .hints = {.likely = likely},
                                                 .want_occluders = true});
  if (found.witness) return false;
  std::sort(found.occluders.begin(), found.occluders.end());
  found.occluders.erase(std::unique(found.occluders.begin(), found.occluders.end()),
                        found.occluders.end());
  likely = std::move(found.occluders);
  return true;
}

}  // namespace farhorizon
