// A point p at the distance m > 1 from the centre of the unit sphere is tangent to it at the angle
// beta from p, cos beta = 1 / m. Along a direction at the angle alpha from p, the point at distance
// 1 / cos(alpha + beta) is on the same tangent: seen by all who see p. The greatest such distance
// over all points is the result's. [RingPatrick13]
#include "core/io/quantized_mesh/horizon_occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geo/ellipsoid.h"

namespace farhorizon {

namespace {

double Dot(const Ecef& a, const Ecef& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Ecef Cross(const Ecef& a, const Ecef& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Ecef Scaled(const Ecef& a, double by) { return {a.x * by, a.y * by, a.z * by}; }

double Length(const Ecef& a) { return std::sqrt(Dot(a, a)); }

}  // namespace

BoundingSphere SphereAround(const std::vector<Ecef>& points) {
  Ecef low = points.front();
  Ecef high = points.front();
  for (const Ecef& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  BoundingSphere sphere = {{(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2}, 0};
  for (const Ecef& p : points) {
    sphere.radius_m =
        std::max(sphere.radius_m,
                 Length({p.x - sphere.centre.x, p.y - sphere.centre.y, p.z - sphere.centre.z}));
  }
  return sphere;
}

std::optional<Ecef> HorizonOcclusionPoint(const std::vector<Ecef>& points, const Ecef& towards,
                                          double least_height_m) {
  const double shrunk_m = std::min(least_height_m, 0.0);
  const double equatorial_m = kEquatorialRadiusM + shrunk_m;
  const double polar_m = kPolarRadiusM + shrunk_m;
  const auto scaled = [&](const Ecef& p) -> Ecef {
    return {p.x / equatorial_m, p.y / equatorial_m, p.z / polar_m};
  };
  const Ecef to = scaled(towards);
  if (!(Length(to) > 0)) return std::nullopt;
  const Ecef direction = Scaled(to, 1 / Length(to));
  double greatest = 0;
  for (const Ecef& point : points) {
    const Ecef p = scaled(point);
    const double distance = Length(p);
    const double m = std::max(distance, 1.0);
    const Ecef unit = Scaled(p, 1 / distance);
    const double cos_alpha = Dot(unit, direction);
    const double sin_alpha = Length(Cross(unit, direction));
    const double cos_beta = 1 / m;
    const double sin_beta = std::sqrt(m * m - 1) * cos_beta;
    const double cos_sum = cos_alpha * cos_beta - sin_alpha * sin_beta;
    // From a right angle on the tangent does not meet the direction; close to it, at a distance at
    // which the product of doubles says nothing.
    if (!(cos_sum > std::numeric_limits<float>::epsilon())) return std::nullopt;
    greatest = std::max(greatest, 1 / cos_sum);
  }
  return Scaled(direction, greatest);
}

}  // namespace farhorizon
