#include "core/pipeline/terrain_tiles/zoom_plan.h"

#include <cmath>
#include <numbers>

#include "core/geo/ellipsoid.h"
#include "core/geometry/floor_divide.h"

namespace farhorizon {

namespace {

// A tile is 5 m wide there: the u of a vertex has a step of 0.1 mm.
constexpr int kDeepestZoom = 22;

}  // namespace

std::int64_t CountTiles(int zoom, const PlaceBox& box) {
  const std::int64_t side = TileSide(zoom);
  return (FloorDivide(box.greatest.x, side) - FloorDivide(box.least.x, side) + 1) *
         (FloorDivide(box.greatest.y, side) - FloorDivide(box.least.y, side) + 1);
}

double ClientErrorAt(int zoom) {
  constexpr double kZoom0 = kEquatorialRadiusM * 2 * std::numbers::pi * 0.25 / (65 * 2);
  return std::ldexp(kZoom0, -zoom);
}

ZoomPlan PlanZooms(const std::vector<double>& errors_m, double most_height_m, const PlaceBox& box) {
  ZoomPlan plan;
  std::int64_t tiles = 0;
  for (int zoom = 0; zoom <= kDeepestZoom; ++zoom) {
    tiles += CountTiles(zoom, box);
    const double error_m = ClientErrorAt(zoom);
    if (zoom > 0 && (tiles > kMostTerrainTiles || error_m < errors_m.front())) break;
    std::size_t level = errors_m.size() - 1;
    while (level > 0 && errors_m[level] > error_m) --level;
    plan.push_back(most_height_m <= error_m ? std::nullopt : std::optional(level));
  }
  plan.back() = 0;
  return plan;
}

}  // namespace farhorizon
