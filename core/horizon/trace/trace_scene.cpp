#include "core/horizon/trace/trace_scene.h"

namespace farhorizon {
namespace {

using kinetic::ClusterId;
using kinetic::MovingPoint;
using kinetic::PointId;
using kinetic::Scene;

PlanPoint Where(const MovingPoint& p, std::int64_t s) {
  const auto d = static_cast<double>(p.d);
  const auto at = [s, d](std::int64_t x, std::int64_t v) {
    return (static_cast<double>(x) + static_cast<double>(v) * static_cast<double>(s)) / d;
  };
  return {at(p.x, p.vx), at(p.y, p.vy)};
}

}  // namespace

void TraceScene(const Scene& scene, std::int64_t s, SweepTrace& trace) {
  const auto where = [&](PointId p) { return Where(scene.point(p).path, s); };
  for (const ClusterId c : scene.apart()) {
    std::vector<PlanPoint>& hull = trace.hulls.emplace_back();
    for (const PointId p : scene.cluster(c).corners) hull.push_back(where(p));
  }
  for (const ClusterId a : scene.apart()) {
    for (const ClusterId b : scene.apart()) {
      if (a >= b) continue;
      const std::int32_t first = scene.FirstTangent(a, b);
      for (std::int32_t t = first; t < first + 4; ++t) {
        const Scene::Tangent& tangent = scene.tangent(t);
        trace.bitangents.push_back({{where(tangent.touch[0]), where(tangent.touch[1])},
                                    tangent.sides[0].active || tangent.sides[1].active});
      }
    }
  }
  for (PointId p = 0; p < scene.point_count(); ++p) {
    const Scene::Point& point = scene.point(p);
    if (point.alive && point.seen && point.tag >= 0) trace.horizon_points.push_back(where(p));
  }
}

}  // namespace farhorizon
