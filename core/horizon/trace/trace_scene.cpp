#include "core/horizon/trace/trace_scene.h"

namespace farhorizon {

namespace {

using kinetic::BitangentScene;
using kinetic::ClusterId;
using kinetic::KineticHulls;
using kinetic::MovingPoint;
using kinetic::PointId;
using kinetic::TangentId;

PlanPoint Where(const MovingPoint& p, std::int64_t s) {
  const auto d = static_cast<double>(p.d);
  const auto at = [s, d](std::int64_t x, std::int64_t v) {
    return (static_cast<double>(x) + static_cast<double>(v) * static_cast<double>(s)) / d;
  };
  return {at(p.x, p.vx), at(p.y, p.vy)};
}

}  // namespace

void TraceScene(const BitangentScene& scene, std::int64_t s, SweepTrace& trace) {
  const KineticHulls& hulls = scene.hulls();
  const auto where = [&](PointId p) { return Where(hulls.point(p).path, s); };
  for (const ClusterId c : hulls.clusters()) {
    std::vector<PlanPoint>& hull = trace.hulls.emplace_back();
    for (const PointId p : hulls.hull(c).corners) hull.push_back(where(p));
  }
  for (const ClusterId a : hulls.clusters()) {
    for (const ClusterId b : hulls.clusters()) {
      if (a >= b) continue;
      const TangentId first = scene.tangents().First(a, b);
      for (TangentId t = first; t < first + 4; ++t) {
        const auto [p, q] = scene.tangents().contacts(t);
        const bool active = scene.order().IsActive(2 * t) || scene.order().IsActive(2 * t + 1);
        trace.bitangents.push_back({{where(p), where(q)}, active});
      }
    }
  }
  for (PointId p = 0; p < hulls.point_count(); ++p) {
    const bool on_horizon = scene.order().corner(p).on_horizon;
    if (hulls.point(p).alive && on_horizon && hulls.point(p).tag >= 0) {
      trace.horizon_points.push_back(where(p));
    }
  }
}

}  // namespace farhorizon
