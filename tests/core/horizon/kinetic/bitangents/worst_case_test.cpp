// The worst cases of the thesis's chapter 4, which no grid holds, played on a scene by itself.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/kinetic/bitangents/bitangent_scene.h"

namespace farhorizon::kinetic {
namespace {

/// Chains A and B of lemmas 4.3 and 4.8, in rational form: b_0 rises along the diagonal past a line
/// of points a_j that overtake one another, and all other b_k hang just under the line from it to
/// (d, 0).
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
  /// In place of b_k, one that stays l / scale above the line (lemma 4.14).
  [[nodiscard]] MovingPoint Above(std::int64_t k, std::int64_t l) const {
    MovingPoint point = B(k);
    point.x += k + l;
    point.y += k + l;
    return point;
  }
  /// Where a point moves that starts at b_k and is `share` of the way that b_k goes in n, at `y`.
  [[nodiscard]] MovingPoint Below(std::int64_t k, std::int64_t quarters, std::int64_t y) const {
    MovingPoint point = B(k);
    point.x = 4 * (point.x + k) + quarters * n_ * point.vx;
    point.y = 4 * y * point.d;
    point.d *= 4;
    point.vx = point.vy = 0;
    return point;
  }
  [[nodiscard]] std::int64_t d() const { return d_; }

 private:
  std::int64_t n_;
  std::int64_t d_;
};

constexpr std::int32_t kFoot = -1;

/// Plays the scene up to `end`, calling look() after each step, the first included.
template <typename Look>
void Play(BitangentScene& scene, std::int64_t end, const Look& look) {
  scene.Advance(SweepDepth::At(0));
  scene.RestoreInvariants();
  look();
  for (std::optional<SweepDepth> at = scene.NextEvent();
       at && Compare(*at, SweepDepth::At(end)) < 0; at = scene.NextEvent()) {
    scene.Advance(*at);
    scene.RestoreInvariants();
    look();
  }
}

class WorstCase : public testing::TestWithParam<int> {};

// Lemma 4.4: points of one contour. tag: j for a_j, n + k for b_k.
TEST_P(WorstCase, TakesTheBridgeOfOneHullThroughEveryPair) {
  const std::int64_t n = GetParam();
  const Chains chains(n);
  BitangentScene scene;
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
    for (PointId p = 0; p < scene.hulls().point_count(); ++p) {
      const KineticPoint& from = scene.hulls().point(p);
      if (from.tag < n) continue;
      const auto k = static_cast<std::size_t>(from.tag - n);
      if (from.corner && !was[k]) ++periods[k];
      was[k] = from.corner;
      if (!from.corner) continue;
      const std::int32_t to = scene.hulls().point(from.next).tag;
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

/// The slopes of the lines that a hull leaves free at a corner, for as long as it is one.
struct Slopes {
  double least = 1e9;
  double most = -1e9;
};

/// The chains of one hull, played slowly, and what is free at each b_k in each of its periods as a
/// corner: at every event, and at kSlow depths between two whole ones.
class DirectionsAtB {
 public:
  explicit DirectionsAtB(std::int64_t n) : end_(n * kSlow), periods_(static_cast<std::size_t>(n)) {
    const Chains chains(n);
    const ClusterId c = scene_.NewCluster();
    for (std::int64_t i = 0; i < n; ++i) {
      scene_.Add(c, Slowly(chains.A(i)), end_, kFoot);
      scene_.Add(c, Slowly(chains.B(i)), end_, static_cast<std::int32_t>(i));
    }
    scene_.Add(c, MovingPoint::Standing(-chains.d(), -9999), kNever, kFoot);
    scene_.Add(c, MovingPoint::Standing(chains.d(), -9999), kNever, kFoot);
    was_corner_.resize(periods_.size());
    for (std::int64_t s = 0; s < end_; ++s) {
      PlayUntil(s);
      LookAfter(SweepDepth::At(s));
    }
    PlayUntil(end_);
  }

  /// Those at b_k, a period each.
  [[nodiscard]] const std::vector<Slopes>& At(std::size_t k) const { return periods_[k]; }

 private:
  static constexpr std::int64_t kSlow = 64;

  static MovingPoint Slowly(const MovingPoint& p) {
    return {p.x * kSlow, p.vx, p.y * kSlow, p.vy, p.d * kSlow};
  }
  void PlayUntil(std::int64_t s) {
    for (std::optional<SweepDepth> at = scene_.NextEvent();
         at && Compare(*at, SweepDepth::At(s)) < 0; at = scene_.NextEvent()) {
      LookAfter(*at);
    }
  }
  void LookAfter(const SweepDepth& now) {
    scene_.Advance(now);
    scene_.RestoreInvariants();
    for (PointId p = 0; p < scene_.hulls().point_count(); ++p) {
      if (scene_.hulls().point(p).tag != kFoot) LookAt(p, now);
    }
  }
  void LookAt(PointId p, const SweepDepth& now) {
    const KineticPoint& point = scene_.hulls().point(p);
    const auto k = static_cast<std::size_t>(point.tag);
    if (point.corner && !was_corner_[k]) periods_[k].emplace_back();
    was_corner_[k] = point.corner;
    if (!point.corner) return;
    Slopes& slopes = periods_[k].back();
    slopes.least = std::min(slopes.least, SlopeTo(point.prev, point, now));
    slopes.most = std::max(slopes.most, SlopeTo(point.next, point, now));
  }
  double SlopeTo(PointId to, const KineticPoint& from, const SweepDepth& now) {
    const Aim aim = AimAt(from.path, scene_.hulls().point(to).path, now);
    return aim.y / aim.x;
  }

  std::int64_t end_;
  BitangentScene scene_;
  std::vector<std::vector<Slopes>> periods_;
  std::vector<bool> was_corner_;
};

// Lemma 4.4 as a bound on the directions of one edge.
TEST_P(WorstCase, SeesEachInnerPointAlongDisjointIntervalsOfDirections) {
  const auto n = static_cast<std::size_t>(GetParam());
  const DirectionsAtB directions(GetParam());
  for (std::size_t k = 1; k + 1 < n; ++k) {
    std::vector<Slopes> slopes = directions.At(k);
    std::ranges::sort(slopes, {}, &Slopes::least);
    ASSERT_EQ(slopes.size(), n + 1) << "b" << k;
    for (std::size_t i = 1; i < slopes.size(); ++i) {
      EXPECT_LT(slopes[i - 1].most, slopes[i].least) << "b" << k << ", interval " << i;
    }
  }
}

// Lemma 4.8: the same chains as two contours, the bridge a scene bitangent, always active.
TEST_P(WorstCase, TakesABitangentOfTwoHullsThroughEveryPair) {
  const std::int64_t n = GetParam();
  const Chains chains(n);
  BitangentScene scene;
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
    const TangentId first = scene.tangents().First(a, b);
    for (TangentId t = first; t < first + 2; ++t) {
      const auto [p, q] = scene.tangents().contacts(t);
      const std::pair pair(scene.hulls().point(p).tag, scene.hulls().point(q).tag);
      if (pair.first == kFoot || pair.second == kFoot) continue;  // the lower one
      EXPECT_TRUE(scene.order().IsActive(2 * t) && scene.order().IsActive(2 * t + 1));
      if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);
    }
  });
  EXPECT_EQ(static_cast<std::int64_t>(pairs.size()) - 1, 2 * n * n - n - 1);
  EXPECT_EQ(static_cast<std::int64_t>(std::set(pairs.begin(), pairs.end()).size()), n * n);
  EXPECT_EQ(scene.counts().tangent_failures[0] + scene.counts().tangent_failures[1], 0)
      << "two hulls make no tritangents";
  EXPECT_GE(scene.counts().tangent_failures[2], 2 * n * n - n - 1);
}

// Lemma 4.11: the same two contours with a mountain between them, which occludes all bitangents.
TEST_P(WorstCase, TakesAnInactiveBitangentThroughEveryPair) {
  const std::int64_t n = GetParam();
  const Chains chains(n);
  BitangentScene scene;
  const ClusterId a = scene.NewCluster();
  const ClusterId b = scene.NewCluster();
  const ClusterId mountain = scene.NewCluster();
  for (std::int64_t i = 0; i < n; ++i) {
    scene.Add(a, chains.A(i), n, static_cast<std::int32_t>(i));
    scene.Add(b, chains.B(i), n, static_cast<std::int32_t>(i));
  }
  scene.Add(a, MovingPoint::Standing(-chains.d() - n, -9999), kNever, kFoot);
  scene.Add(b, MovingPoint::Standing(chains.d() / 2, -9999), kNever, kFoot);
  for (const std::int64_t x : {-1, 1}) {
    for (const std::int64_t y : {-99'999, 99'999}) {
      scene.Add(mountain, MovingPoint::Standing(x - chains.d() / 2, y), kNever, kFoot);
    }
  }

  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  Play(scene, n, [&] {
    scene.CheckAll();
    const TangentId first = scene.tangents().First(a, b);
    for (TangentId t = first; t < first + 4; ++t) {
      EXPECT_FALSE(scene.order().IsActive(2 * t) || scene.order().IsActive(2 * t + 1));
      const auto [p, q] = scene.tangents().contacts(t);
      const std::pair pair(scene.hulls().point(p).tag, scene.hulls().point(q).tag);
      if (!TangentTable::Outer(t) || pair.first == kFoot || pair.second == kFoot) continue;
      if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);
    }
  });
  EXPECT_EQ(static_cast<std::int64_t>(pairs.size()) - 1, 2 * n * n - n - 1);
  EXPECT_EQ(static_cast<std::int64_t>(std::set(pairs.begin(), pairs.end()).size()), n * n);
  EXPECT_GE(scene.counts().tangent_failures[3], 2 * n * n - n - 1) << "inactive, at hull edges";
}

// Lemma 4.14: the last points of chain B are the tops of contours of their own, which stay just
// above the line that the others stay below. Each time the bridge of the two chains changes, the
// certificates of the bitangents from a_j to these tops have another edge of the hull.
TEST_P(WorstCase, UpdatesTheCertificatesOfAllContoursWhereTheBridgeChanges) {
  const std::int64_t n = GetParam();
  const std::int64_t contours = n / 2;
  const std::int64_t on_chain = n - contours;
  const Chains chains(n);
  BitangentScene scene;
  const ClusterId c = scene.NewCluster();
  for (std::int64_t i = 0; i < n; ++i) {
    scene.Add(c, chains.A(i), n, static_cast<std::int32_t>(i));
    if (i < on_chain) scene.Add(c, chains.B(i), n, static_cast<std::int32_t>(n + i));
  }
  scene.Add(c, MovingPoint::Standing(-chains.d(), -9999), kNever, kFoot);
  scene.Add(c, chains.Below(on_chain - 1, 6, -9999), kNever, kFoot);
  for (std::int64_t l = 0; l < contours; ++l) {
    const ClusterId contour = scene.NewCluster();
    scene.Add(contour, chains.Above(on_chain + l, l + 1), n, static_cast<std::int32_t>(2 * n + l));
    scene.Add(contour, chains.Below(on_chain + l, -1, -9999), kNever, kFoot);
    scene.Add(contour, chains.Below(on_chain + l, 5, -9999), kNever, kFoot);
  }

  std::int64_t changes = -1;
  std::pair<std::int32_t, std::int32_t> bridge(-1, -1);
  Play(scene, n, [&] {
    scene.CheckAll();
    for (const PointId p : scene.hulls().corners(scene.Find(c))) {
      const KineticPoint& from = scene.hulls().point(p);
      const std::int32_t to = scene.hulls().point(from.next).tag;
      if (from.tag < n || to == kFoot || to >= n || bridge == std::pair(to, from.tag)) continue;
      bridge = {to, from.tag};
      ++changes;
    }
  });
  EXPECT_EQ(scene.counts().merges, 0);
  EXPECT_GE(changes, 2 * n * on_chain - n - 1);
  EXPECT_GE(scene.certificates().edge_updates(), changes * (contours - 1));
}

INSTANTIATE_TEST_SUITE_P(Chains, WorstCase, testing::Values(3, 4, 5, 6, 8, 10));

}  // namespace
}  // namespace farhorizon::kinetic
