// A scene's tangents against the definition of their activity, at every event.
#include "core/horizon/kinetic/bitangents/bitangent_scene.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/kinetic/hulls/hull_location.h"
#include "tests/support/effort.h"

namespace farhorizon::kinetic {
namespace {

/// Whether the line of a tangent has corners of a third hull on both its sides just after `now`.
bool CutsAThirdHull(const BitangentScene& scene, TangentId t, const SweepDepth& now) {
  const KineticHulls& hulls = scene.hulls();
  const auto [p, q] = scene.tangents().contacts(t);
  return std::any_of(hulls.clusters().begin(), hulls.clusters().end(), [&](ClusterId c) {
    const std::vector<PointId>& ring = hulls.hull(c).corners;
    if (std::find(ring.begin(), ring.end(), p) != ring.end() ||
        std::find(ring.begin(), ring.end(), q) != ring.end()) {
      return false;
    }
    int sides = 0;
    for (const PointId r : ring) {
      const int side =
          OrientAfter(hulls.point(p).path, hulls.point(q).path, hulls.point(r).path, now);
      sides |= side > 0 ? 1 : 2;
    }
    return sides == 3;
  });
}

void CheckActivities(BitangentScene& scene, const SweepDepth& now) {
  scene.CheckAll();
  for (const ClusterId a : scene.hulls().clusters()) {
    for (const ClusterId b : scene.hulls().clusters()) {
      if (a >= b) continue;
      const TangentId first = scene.tangents().First(a, b);
      for (TangentId t = first; t < first + 4; ++t) {
        const bool expected = !CutsAThirdHull(scene, t, now);
        ASSERT_EQ(scene.order().IsActive(2 * t), expected);
        ASSERT_EQ(scene.order().IsActive(2 * t + 1), expected);
      }
    }
  }
}

// Summits of eight ridges each, far from any tie.
TEST(Scene, KnowsAtEveryEventWhichTangentsAreActive) {
  std::mt19937 random(1);
  const auto any = [&random](std::int32_t low, std::int32_t high) {
    return std::uniform_int_distribution(low, high)(random);
  };
  SceneCounts sum;
  for (int round = 0; round < Rounds(20); ++round) {
    BitangentScene scene;
    std::int64_t s = 0;
    for (int peak = 0; peak < 12; ++peak, s += any(1, 400)) {
      for (std::optional<SweepDepth> at = scene.NextEvent();
           at && Compare(*at, SweepDepth::At(s)) < 0; at = scene.NextEvent()) {
        scene.Advance(*at);
        scene.RestoreInvariants();
        CheckActivities(scene, *at);
      }
      scene.Advance(SweepDepth::At(s));
      const Point3i top{any(0, 5000), any(0, 5000), static_cast<std::int32_t>(-s)};
      const auto clusters = scene.hulls().clusters();
      if (std::none_of(clusters.begin(), clusters.end(), [&](ClusterId c) {
            return SurelyInsideAt(scene.hulls(), c, top.x, top.y, s);
          })) {
        const ClusterId c = scene.NewCluster();
        const int signs[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                 {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
        for (const auto& [x, y] : signs) {
          const Point3i foot{top.x + x * any(9000, 15000) + any(1, 99),
                             top.y + y * any(9000, 15000) + any(1, 99), top.z - 30000 - any(0, 99)};
          scene.Add(c, MovingPoint::Sliding(top, foot, 0), -foot.z, 0);
        }
      }
      scene.RestoreInvariants();
      CheckActivities(scene, SweepDepth::At(s));
      if (HasFatalFailure()) return;
    }
    for (std::size_t i = 0; i < 4; ++i)
      sum.tangent_failures[i] += scene.counts().tangent_failures[i];
    sum.merges += scene.counts().merges;
  }
  // All that can happen did: figure 3.1's four kinds, and collisions.
  for (const std::int64_t n : sum.tangent_failures) EXPECT_GT(n, Rounds(20));
  EXPECT_GT(sum.merges, Rounds(20));
}

}  // namespace
}  // namespace farhorizon::kinetic
