#include "core/horizon/kinetic/neighbours/separating_tangents.h"

#include <array>
#include <cstdint>
#include <optional>

#include <gtest/gtest.h>

#include "core/base/result.h"

namespace farhorizon::kinetic {
namespace {

/// A stands on the left; B, on the right, comes nearer by `speed` a depth.
class SeparatingTangentOfTwoDiamonds : public testing::Test {
 protected:
  SeparatingTangentOfTwoDiamonds() {
    hulls_.AdvanceTo(SweepDepth::At(0));
    a_ = AddDiamond(0, 0);
    b_ = AddDiamond(10, -1);
    tangents_.Make(a_, b_);
  }
  ClusterId AddDiamond(std::int64_t left, std::int64_t speed) {
    const ClusterId c = hulls_.NewCluster();
    tangents_.AddCluster();
    for (const auto& [x, y] : {std::array{0, 0}, {2, -2}, {4, 0}, {2, 2}}) {
      hulls_.Add(c, {left + x, speed, y, 0, 1}, kNever, 0);
    }
    hulls_.UpdateHull(c);
    return c;
  }

  CertificateQueue queue_;
  StepMarks marks_;
  KineticHulls hulls_{queue_, marks_};
  SeparatingTangents tangents_{queue_, hulls_};
  ClusterId a_ = -1;
  ClusterId b_ = -1;
};

TEST_F(SeparatingTangentOfTwoDiamonds, HasThemOnItsTwoSides) {
  ASSERT_TRUE(tangents_.Exists(a_, b_));
  ASSERT_TRUE(tangents_.Exists(b_, a_));
  const TangentId t = tangents_.Of(a_)[0];
  EXPECT_EQ(tangents_.Of(b_)[0], t);
  const SeparatingTangent& tangent = tangents_.tangent(t);
  for (const PointId p : hulls_.corners(tangent.a)) {
    EXPECT_GE(hulls_.Orient(tangent.p, tangent.q, p), 0);
  }
  for (const PointId p : hulls_.corners(tangent.b)) {
    EXPECT_LE(hulls_.Orient(tangent.p, tangent.q, p), 0);
  }
  EXPECT_NO_THROW(tangents_.CheckTangent(t));
}

TEST_F(SeparatingTangentOfTwoDiamonds, SaysWhenTheyCome) {
  const TangentId t = tangents_.Of(a_)[0];
  bool is_apart = true;
  while (is_apart) {
    const std::optional<SweepDepth> at = queue_.NextDepth();
    ASSERT_TRUE(at) << "some certificate fails before the two meet, at depth 6";
    ASSERT_LE(Compare(*at, SweepDepth::At(6)), 0);
    hulls_.AdvanceTo(*at);
    while (queue_.PopAt(*at)) {
    }
    is_apart = tangents_.Restore(t);
    if (!is_apart) break;
    EXPECT_NO_THROW(tangents_.CheckTangent(t));
  }
  EXPECT_EQ(Compare(hulls_.now(), SweepDepth::At(6)), 0);
}

TEST_F(SeparatingTangentOfTwoDiamonds, DropsThoseOfAHullAndTakesTheirPlaceAgain) {
  EXPECT_EQ(tangents_.count(), 1);
  tangents_.DropAllOf(b_);
  EXPECT_EQ(tangents_.count(), 0);
  EXPECT_FALSE(tangents_.Exists(a_, b_));
  EXPECT_TRUE(tangents_.Of(a_).empty());
  EXPECT_FALSE(queue_.NextDepth());
  tangents_.Make(b_, a_);
  EXPECT_EQ(tangents_.Of(a_)[0], 0);
  EXPECT_NO_THROW(tangents_.CheckTangent(0));
}

}  // namespace
}  // namespace farhorizon::kinetic
