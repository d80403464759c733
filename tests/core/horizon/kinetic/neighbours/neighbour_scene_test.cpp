// A scene of neighbours against one of all pairs, point by point, and its invariants.
#include "core/horizon/kinetic/neighbours/neighbour_scene.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "core/horizon/kinetic/bitangents/bitangent_scene.h"
#include "core/horizon/kinetic/hulls/hull_location.h"
#include "tests/support/effort.h"

namespace farhorizon::kinetic {
namespace {

template <typename Scene>
void SinkTo(Scene& scene, std::int64_t s) {
  for (std::optional<SweepDepth> at = scene.NextEvent(); at && Compare(*at, SweepDepth::At(s)) < 0;
       at = scene.NextEvent()) {
    scene.Advance(*at);
    scene.RestoreInvariants();
    scene.CheckAll();
  }
  scene.Advance(SweepDepth::At(s));
}

// Summits of eight ridges each, far from any tie.
TEST(NeighbourScene, FindsTheHorizonOfTheSceneOfAllPairs) {
  std::mt19937 random(1);
  const auto any = [&random](std::int32_t low, std::int32_t high) {
    return std::uniform_int_distribution(low, high)(random);
  };
  std::int64_t failures = 0;
  std::int64_t hidden = 0;
  for (int round = 0; round < Rounds(20); ++round) {
    NeighbourScene neighbours(round % 2 == 0 ? HullCertificates::kTurns : HullCertificates::kTree);
    BitangentScene all_pairs;
    std::int64_t s = 0;
    for (int peak = 0; peak < 12; ++peak, s += any(1, 400)) {
      SinkTo(neighbours, s);
      SinkTo(all_pairs, s);
      const Point3i top{any(0, 5000), any(0, 5000), static_cast<std::int32_t>(-s)};
      const auto clusters = neighbours.hulls().clusters();
      if (std::none_of(clusters.begin(), clusters.end(), [&](ClusterId c) {
            return SurelyInsideAt(neighbours.hulls(), c, top.x, top.y, s);
          })) {
        const ClusterId c = neighbours.NewCluster();
        const ClusterId d = all_pairs.NewCluster();
        const int signs[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                 {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
        for (const auto& [x, y] : signs) {
          const Point3i foot{top.x + x * any(9000, 15000) + any(1, 99),
                             top.y + y * any(9000, 15000) + any(1, 99), top.z - 30000 - any(0, 99)};
          const MovingPoint path = MovingPoint::Sliding(top, foot, 0);
          ASSERT_EQ(neighbours.Add(c, path, -foot.z, 0), all_pairs.Add(d, path, -foot.z, 0));
        }
      }
      neighbours.RestoreInvariants();
      neighbours.CheckAll();
      all_pairs.RestoreInvariants();
    }
    for (PointId p = 0; p < neighbours.hulls().point_count(); ++p) {
      ASSERT_EQ(neighbours.OnHorizon(p), all_pairs.OnHorizon(p)) << "round " << round << ", " << p;
      if (!neighbours.OnHorizon(p)) ++hidden;
    }
    EXPECT_EQ(neighbours.counts().merges, all_pairs.counts().merges);
    failures += neighbours.counts().cover_failures + neighbours.counts().separation_failures;
  }
  EXPECT_GT(hidden, Rounds(20));
  EXPECT_GT(failures, Rounds(20));
}

TEST(NeighbourScene, EndsAStepWhereItMayLookAtNoMoreHulls) {
  NeighbourScene scene(HullCertificates::kTurns, 10);
  scene.Advance(SweepDepth::At(0));
  for (std::int64_t i = 0; i < 100; ++i) {
    const ClusterId c = scene.NewCluster();
    scene.Add(c, MovingPoint::Standing(10 * i, i * i), kNever, 0);
    scene.Add(c, MovingPoint::Standing(10 * i + 3, i * i), kNever, 0);
    scene.Add(c, MovingPoint::Standing(10 * i + 1, i * i + 3), kNever, 0);
  }
  scene.RestoreInvariants();
  EXPECT_GT(scene.counts().looks, 10);
  EXPECT_LE(scene.counts().looks, 10 + 2 * 100) << "of 10,000 pairs";
}

}  // namespace
}  // namespace farhorizon::kinetic
