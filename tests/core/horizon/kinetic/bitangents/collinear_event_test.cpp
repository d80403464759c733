// Three hulls, one of which passes the tangent of the others: what collinear_event.h draws.
#include "core/horizon/kinetic/bitangents/collinear_event.h"

#include <array>
#include <cstdint>
#include <optional>

#include <gtest/gtest.h>

#include "core/horizon/kinetic/bitangents/bitangent_scene.h"

namespace farhorizon::kinetic {
namespace {

constexpr std::int32_t kTopTag = 1;
constexpr std::int32_t kBottom = 2;

/// P and R of radius 3, which stand, and between them Q of radius 1, at a height that changes by
/// `speed` per depth; y goes up.
class ThreeDiamonds {
 public:
  ThreeDiamonds(std::int64_t height, std::int64_t speed) {
    scene_.Advance(SweepDepth::At(0));
    p_ = Add({0, 0, 0, 0, 1}, 3);
    q_ = Add({20, 0, height, speed, 1}, 1);
    r_ = Add({40, 0, 0, 0, 1}, 3);
    scene_.RestoreInvariants();
    scene_.CheckAll();
  }
  void PlayTo(std::int64_t s) {
    for (std::optional<SweepDepth> at = scene_.NextEvent();
         at && Compare(*at, SweepDepth::At(s)) < 0; at = scene_.NextEvent()) {
      scene_.Advance(*at);
      scene_.RestoreInvariants();
      scene_.CheckAll();
    }
  }
  /// Whether pq, qr and pr are active, which touch P and R at their tops and Q at `at_q`.
  [[nodiscard]] std::array<bool, 3> Active(std::int32_t at_q) const {
    return {IsActive(p_, q_, at_q), IsActive(r_, q_, at_q), IsActive(p_, r_, kTopTag)};
  }
  [[nodiscard]] const SceneCounts& counts() const { return scene_.counts(); }

 private:
  ClusterId Add(const MovingPoint& centre, std::int64_t radius) {
    const ClusterId c = scene_.NewCluster();
    const auto add = [&](std::int64_t x, std::int64_t y, std::int32_t tag) {
      MovingPoint corner = centre;
      corner.x += x;
      corner.y += y;
      scene_.Add(c, corner, kNever, tag);
    };
    add(-radius, 0, 0);
    add(0, -radius, kBottom);
    add(radius, 0, 0);
    add(0, radius, kTopTag);
    return c;
  }
  /// Of the tangent that touches a at its top and b at the corner with the tag.
  [[nodiscard]] bool IsActive(ClusterId a, ClusterId b, std::int32_t tag_at_b) const {
    const TangentId first = scene_.tangents().First(a, b);
    for (HalfTangentId half = 2 * first; half < 2 * (first + 4); ++half) {
      const KineticPoint& own = scene_.hulls().point(scene_.tangents().Own(half));
      const KineticPoint& other = scene_.hulls().point(scene_.tangents().Other(half));
      if (own.cluster != a || own.tag != kTopTag || other.tag != tag_at_b) continue;
      EXPECT_EQ(scene_.order().IsActive(half), scene_.order().IsActive(Opposite(half)));
      return scene_.order().IsActive(half);
    }
    ADD_FAILURE() << "no such tangent";
    return false;
  }

  BitangentScene scene_;
  ClusterId p_ = -1;
  ClusterId q_ = -1;
  ClusterId r_ = -1;
};

constexpr std::array kOnlyPr{false, false, true};
constexpr std::array kAllButPr{true, true, false};

TEST(CollinearEvent, GivesThePlacesOfPrToPqAndQrWhereQRises) {
  ThreeDiamonds hulls(0, 1);
  hulls.PlayTo(2);
  EXPECT_EQ(hulls.Active(kTopTag), kOnlyPr);
  const SceneCounts before = hulls.counts();
  hulls.PlayTo(3);
  EXPECT_EQ(hulls.Active(kTopTag), kAllButPr);
  // Active and inactive at p and at r; the two inactive ones at q had no certificate between them.
  EXPECT_EQ(hulls.counts().tangent_failures[1] - before.tangent_failures[1], 2);
}

TEST(CollinearEvent, GivesThemBackWhereQSinks) {
  ThreeDiamonds hulls(4, -1);
  hulls.PlayTo(2);
  EXPECT_EQ(hulls.Active(kTopTag), kAllButPr);
  const SceneCounts before = hulls.counts();
  hulls.PlayTo(3);
  EXPECT_EQ(hulls.Active(kTopTag), kOnlyPr);
  EXPECT_EQ(hulls.counts().tangent_failures[0] - before.tangent_failures[0], 1);
  EXPECT_EQ(hulls.counts().tangent_failures[1] - before.tangent_failures[1], 2);
}

TEST(CollinearEvent, ClosesThreeGapsWhereQComesDownOnPr) {
  ThreeDiamonds hulls(6, -1);
  hulls.PlayTo(2);
  EXPECT_EQ(hulls.Active(kBottom), (std::array{true, true, true}));
  const SceneCounts before = hulls.counts();
  hulls.PlayTo(3);
  EXPECT_EQ(hulls.Active(kBottom), (std::array{false, false, false}));
  EXPECT_EQ(hulls.counts().tangent_failures[0] - before.tangent_failures[0], 3);
}

}  // namespace
}  // namespace farhorizon::kinetic
