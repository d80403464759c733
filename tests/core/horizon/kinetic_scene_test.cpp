// The scene by itself: the worst cases of the thesis's chapter 4, which no grid holds, and the activity of
// every tangent against its definition.
#include <algorithm>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/kinetic/scene.h"
#include "tests/support/effort.h"

namespace farhorizon::kinetic {
namespace {

/// Chains A and B of lemmas 4.3 and 4.8, in rational form: b_0 rises along the diagonal past a line of
/// points a_j that overtake one another, and all other b_k hang just under the line from it to (d, 0).
class Chains {
 public:
  explicit Chains(std::int64_t n) : n_(n), d_(4 * n + 2) {}

  [[nodiscard]] MovingPoint A(std::int64_t j) const {
    const std::int64_t scale = (d_ - j) * (d_ - j - 1);
    return {(-d_ - j) * scale, 0, -(2 * d_ + j) * j * (j + 1), (2 * d_ + j) * d_, scale};
  }
  [[nodiscard]] MovingPoint B(std::int64_t k) const {
    const std::int64_t scale = (std::int64_t{1} << (n_ + 2)) * 8 * d_;
    const std::int64_t part = scale >> k;
    return {d_ * (scale - part) - k, part, -k, part, scale};
  }
  [[nodiscard]] std::int64_t d() const { return d_; }

 private:
  std::int64_t n_;
  std::int64_t d_;
};

constexpr std::int32_t kFoot = -1;

/// Plays the scene up to `end`, calling look() after each step, the first included.
template <typename Look>
void Play(Scene& scene, std::int64_t end, const Look& look) {
  scene.Advance(Moment::At(0));
  scene.Settle();
  look();
  for (std::optional<Moment> at = scene.NextFailure(); at && Compare(*at, Moment::At(end)) < 0;
       at = scene.NextFailure()) {
    scene.Advance(*at);
    scene.Settle();
    look();
  }
}

class WorstCase : public testing::TestWithParam<int> {};

// Lemma 4.4: points of one contour. tag: j for a_j, n + k for b_k.
TEST_P(WorstCase, TakesTheBridgeOfOneHullThroughEveryPair) {
  const std::int64_t n = GetParam();
  const Chains chains(n);
  Scene scene;
  const ClusterId c = scene.NewCluster();
  for (std::int64_t i = 0; i < n; ++i) {
    scene.Add(c, chains.A(i), n, static_cast<std::int32_t>(i));
    scene.Add(c, chains.B(i), n, static_cast<std::int32_t>(n + i));
  }
  scene.Add(c, MovingPoint::Standing(-chains.d(), -9999), kNever, kFoot);
  scene.Add(c, MovingPoint::Standing(chains.d(), -9999), kNever, kFoot);

  std::vector<std::pair<std::int32_t, std::int32_t>> bridges;
  std::vector<int> periods(static_cast<std::size_t>(n), 0);
  std::vector<bool> was(static_cast<std::size_t>(n), false);
  Play(scene, n, [&] {
    scene.CheckAll();
    for (PointId p = 0; p < scene.point_count(); ++p) {
      const Scene::Point& from = scene.point(p);
      if (from.tag < n) continue;
      const auto k = static_cast<std::size_t>(from.tag - n);
      if (from.corner && !was[k]) ++periods[k];
      was[k] = from.corner;
      if (!from.corner) continue;
      const std::int32_t to = scene.point(from.next).tag;
      if (to == kFoot || to >= n) continue;
      if (bridges.empty() || bridges.back() != std::pair(to, from.tag)) {
        bridges.emplace_back(to, from.tag);
      }
    }
  });

  const auto pairs = static_cast<std::size_t>(n * n);
  EXPECT_EQ(bridges.size() - 1, 2 * pairs - static_cast<std::size_t>(n) - 1) << "changes";
  EXPECT_EQ(std::set(bridges.begin(), bridges.end()).size(), pairs);
  std::size_t i = 0;
  for (std::int32_t j = 0; j < n; ++j) {
    for (std::int32_t step = 1 - static_cast<std::int32_t>(n); step < n; ++step) {
      const std::int32_t k = static_cast<std::int32_t>(n) - 1 - std::abs(step);
      ASSERT_EQ(bridges[i], std::pair(j, static_cast<std::int32_t>(n) + k)) << "bridge " << i;
      ++i;
    }
  }
  for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(n); ++k) {
    EXPECT_EQ(periods[k], n + 1) << "periods in which b" << k << " is on the hull";
  }
}

// Lemma 4.4 as a bound on the directions of an edge: b_1 to b_(n-2) are each touched along n + 1 disjoint
// intervals of them. One interval is what the hull leaves free at a corner as long as it is one, its slopes
// taken at every event and at 64 moments between two whole depths.
TEST(WorstCaseDirections, FallIntoDisjointIntervalsAtTheInnerPointsOfAChain) {
  constexpr std::int64_t kSlow = 64;
  for (const std::int64_t n : {3, 4, 5, 6}) {
    const Chains chains(n);
    Scene scene;
    const ClusterId c = scene.NewCluster();
    const auto slow = [](MovingPoint p) {
      return MovingPoint{p.x * kSlow, p.vx, p.y * kSlow, p.vy, p.d * kSlow};
    };
    for (std::int64_t i = 0; i < n; ++i) {
      scene.Add(c, slow(chains.A(i)), n * kSlow, kFoot);
      scene.Add(c, slow(chains.B(i)), n * kSlow, static_cast<std::int32_t>(i));
    }
    scene.Add(c, MovingPoint::Standing(-chains.d(), -9999), kNever, kFoot);
    scene.Add(c, MovingPoint::Standing(chains.d(), -9999), kNever, kFoot);

    struct Interval {
      double least = 1e9;
      double most = -1e9;
    };
    std::vector<std::vector<Interval>> intervals(static_cast<std::size_t>(n));
    std::vector<bool> was(static_cast<std::size_t>(n), false);
    const auto look = [&](const Moment& now) {
      scene.Advance(now);
      scene.Settle();
      const auto slope = [&](PointId from, PointId to) {
        const Aim aim = AimAt(scene.point(from).path, scene.point(to).path, now);
        return aim.y / aim.x;
      };
      for (PointId p = 0; p < scene.point_count(); ++p) {
        const Scene::Point& point = scene.point(p);
        if (point.tag == kFoot) continue;
        const auto k = static_cast<std::size_t>(point.tag);
        if (point.corner && !was[k]) intervals[k].emplace_back();
        was[k] = point.corner;
        if (!point.corner) continue;
        Interval& interval = intervals[k].back();
        interval.least = std::min(interval.least, slope(p, point.prev));
        interval.most = std::max(interval.most, slope(p, point.next));
      }
    };
    for (std::int64_t s = 0; s <= n * kSlow; ++s) {
      for (std::optional<Moment> at = scene.NextFailure(); at && Compare(*at, Moment::At(s)) < 0;
           at = scene.NextFailure()) {
        look(*at);
      }
      if (s < n * kSlow) look(Moment::At(s));
    }

    for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(n); ++k) {
      std::ranges::sort(intervals[k], {}, &Interval::least);
      ASSERT_EQ(static_cast<std::int64_t>(intervals[k].size()), n + 1) << "b" << k;
      for (std::size_t i = 1; i < intervals[k].size(); ++i) {
        EXPECT_LT(intervals[k][i - 1].most, intervals[k][i].least)
            << "n " << n << ", b" << k << ", interval " << i;
      }
    }
  }
}

// Lemma 4.8: the same chains as two contours, the bridge a scene bitangent, always active.
TEST_P(WorstCase, TakesABitangentOfTwoHullsThroughEveryPair) {
  const std::int64_t n = GetParam();
  const Chains chains(n);
  Scene scene;
  const ClusterId a = scene.NewCluster();
  const ClusterId b = scene.NewCluster();
  for (std::int64_t i = 0; i < n; ++i) {
    scene.Add(a, chains.A(i), n, static_cast<std::int32_t>(i));
    scene.Add(b, chains.B(i), n, static_cast<std::int32_t>(i));
  }
  scene.Add(a, MovingPoint::Standing(-chains.d() - n, -9999), kNever, kFoot);
  scene.Add(b, MovingPoint::Standing(chains.d() / 2, -9999), kNever, kFoot);

  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  Play(scene, n, [&] {
    scene.CheckAll();
    const std::int32_t first = scene.FirstTangent(a, b);
    for (std::int32_t t = first; t < first + 2; ++t) {
      const std::pair pair(scene.point(scene.Own(2 * t)).tag, scene.point(scene.Other(2 * t)).tag);
      if (pair.first == kFoot || pair.second == kFoot) continue;  // the lower one
      EXPECT_TRUE(scene.Active(2 * t) && scene.Active(2 * t + 1));
      if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);
    }
  });
  EXPECT_EQ(static_cast<std::int64_t>(pairs.size()) - 1, 2 * n * n - n - 1);
  EXPECT_EQ(static_cast<std::int64_t>(std::set(pairs.begin(), pairs.end()).size()), n * n);
  EXPECT_EQ(scene.counts().tangent_failures[0] + scene.counts().tangent_failures[1], 0)
      << "two hulls make no tritangents";
  EXPECT_GE(scene.counts().tangent_failures[2], 2 * n * n - n - 1);
}

INSTANTIATE_TEST_SUITE_P(Chains, WorstCase, testing::Values(3, 4, 5, 6, 8, 10));

/// Whether the line of a tangent has corners of a third hull on both its sides just after `now`.
bool MeetsAThirdHull(const Scene& scene, std::int32_t t, const Moment& now) {
  const PointId p = scene.tangent(t).touch[0];
  const PointId q = scene.tangent(t).touch[1];
  return std::any_of(scene.apart().begin(), scene.apart().end(), [&](ClusterId c) {
    const std::vector<PointId>& ring = scene.cluster(c).corners;
    if (std::find(ring.begin(), ring.end(), p) != ring.end() ||
        std::find(ring.begin(), ring.end(), q) != ring.end()) {
      return false;
    }
    int sides = 0;
    for (const PointId r : ring) {
      const int side =
          OrientAfter(scene.point(p).path, scene.point(q).path, scene.point(r).path, now);
      sides |= side > 0 ? 1 : 2;
    }
    return sides == 3;
  });
}

void CheckActivities(Scene& scene, const Moment& now) {
  scene.CheckAll();
  for (const ClusterId a : scene.apart()) {
    for (const ClusterId b : scene.apart()) {
      if (a >= b) continue;
      const std::int32_t first = scene.FirstTangent(a, b);
      for (std::int32_t t = first; t < first + 4; ++t) {
        const bool expected = !MeetsAThirdHull(scene, t, now);
        ASSERT_EQ(scene.Active(2 * t), expected);
        ASSERT_EQ(scene.Active(2 * t + 1), expected);
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
    Scene scene;
    std::int64_t s = 0;
    for (int peak = 0; peak < 12; ++peak, s += any(1, 400)) {
      for (std::optional<Moment> at = scene.NextFailure(); at && Compare(*at, Moment::At(s)) < 0;
           at = scene.NextFailure()) {
        scene.Advance(*at);
        scene.Settle();
        CheckActivities(scene, *at);
      }
      scene.Advance(Moment::At(s));
      const Point3i top{any(0, 5000), any(0, 5000), static_cast<std::int32_t>(-s)};
      if (scene.Around(top.x, top.y) < 0) {
        const ClusterId c = scene.NewCluster();
        const int signs[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                 {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
        for (const auto& [x, y] : signs) {
          const Point3i foot{top.x + x * any(9000, 15000) + any(1, 99),
                             top.y + y * any(9000, 15000) + any(1, 99), top.z - 30000 - any(0, 99)};
          scene.Add(c, MovingPoint::Sliding(top, foot, 0), -foot.z, 0);
        }
      }
      scene.Settle();
      CheckActivities(scene, Moment::At(s));
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
