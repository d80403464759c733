#include "core/io/quantized_mesh/horizon_occlusion.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/geo/ellipsoid.h"

namespace farhorizon {
namespace {

// In axes scaled by the radii: whether the unit sphere is between the camera and the point.
bool IsHidden(const Ecef& camera, const Ecef& point) {
  const Ecef to = {point.x - camera.x, point.y - camera.y, point.z - camera.z};
  const double a = to.x * to.x + to.y * to.y + to.z * to.z;
  const double b = camera.x * to.x + camera.y * to.y + camera.z * to.z;
  const double c = camera.x * camera.x + camera.y * camera.y + camera.z * camera.z - 1;
  const double t = -b / a;
  return t > 0 && t < 1 && b * b > a * c;
}

Ecef Scaled(const Ecef& p, double least_height_m) {
  const double shrunk = std::min(least_height_m, 0.0);
  return {p.x / (kEquatorialRadiusM + shrunk), p.y / (kEquatorialRadiusM + shrunk),
          p.z / (kPolarRadiusM + shrunk)};
}

// Points over a degree, between two heights.
std::vector<Ecef> Ground(double least_m, double greatest_m) {
  std::vector<Ecef> points;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) {
      points.push_back(
          EcefOf({7 + i / 10.0, 46 + j / 10.0, (i + j) % 2 == 0 ? least_m : greatest_m}));
    }
  }
  return points;
}

TEST(HorizonOcclusion, WhoDoesNotSeeThePointSeesNoneOfTheGround) {
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same cameras in each run
  std::uniform_real_distribution<double> share(0, 1);
  for (const auto& [least_m, greatest_m] :
       {std::pair(0.0, 0.0), std::pair(200.0, 4800.0), std::pair(-400.0, 300.0)}) {
    const std::vector<Ecef> ground = Ground(least_m, greatest_m);
    const auto point = HorizonOcclusionPoint(ground, SphereAround(ground).centre, least_m);
    ASSERT_TRUE(point);
    int hidden = 0;
    int seen = 0;
    for (int i = 0; i < 3000; ++i) {
      // Around the place where the ground sinks below the horizon.
      const Geodetic camera = {7.5 + 30 * (share(random) - 0.5), 46.5 + 30 * (share(random) - 0.5),
                               10 + 30'000 * share(random)};
      const Ecef from = Scaled(EcefOf(camera), least_m);
      if (!IsHidden(from, *point)) {
        ++seen;
        continue;
      }
      ++hidden;
      for (const Ecef& p : ground) EXPECT_TRUE(IsHidden(from, Scaled(p, least_m)));
    }
    EXPECT_GT(hidden, 100);
    EXPECT_GT(seen, 100);
  }
}

TEST(HorizonOcclusion, IsNoFurtherThanItMustBe) {
  const std::vector<Ecef> ground = Ground(0, 0);
  const auto point = HorizonOcclusionPoint(ground, SphereAround(ground).centre, 0);
  ASSERT_TRUE(point);
  // A corner is at 0.6 degrees of arc: 1 / cos of it.
  EXPECT_NEAR(std::hypot(point->x, point->y, point->z), 1 + 0.5 * std::pow(0.0106, 2), 2e-5);
}

TEST(HorizonOcclusion, ThereIsNoneForAHemisphere) {
  std::vector<Ecef> points;
  for (int lat = -90; lat <= 90; lat += 10) {
    for (int lon = 0; lon <= 180; lon += 10) points.push_back(EcefOf({lon * 1.0, lat * 1.0, 0}));
  }
  EXPECT_FALSE(HorizonOcclusionPoint(points, SphereAround(points).centre, 0));
}

}  // namespace
}  // namespace farhorizon
