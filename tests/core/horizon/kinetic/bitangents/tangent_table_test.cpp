// The four tangents of two hulls, as tangent_table.h draws them.
#include "core/horizon/kinetic/bitangents/tangent_table.h"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/kinetic/hulls/certificate_queue.h"
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "core/horizon/kinetic/hulls/step_marks.h"

namespace farhorizon::kinetic {
namespace {

/// A on the left, B on the right; y goes up.
class TangentTableOfTwoDiamonds : public testing::Test {
 protected:
  TangentTableOfTwoDiamonds() {
    hulls_.AdvanceTo(SweepDepth::At(0));
    a_ = AddDiamond(0);
    b_ = AddDiamond(10);
    tangents_.Make(b_, a_);
  }
  ClusterId AddDiamond(std::int64_t left) {
    const ClusterId c = hulls_.NewCluster();
    tangents_.AddCluster(c);
    for (const auto& [x, y] : {std::array{0, 0}, {1, -1}, {2, 0}, {1, 1}}) {
      hulls_.Add(c, MovingPoint::Standing(left + x, y), kNever, 0);
    }
    hulls_.UpdateHull(c);
    return c;
  }
  /// The side of the tangent, directed from A to B, that the hull is on: 1 left, -1 right.
  int SideOf(ClusterId c, TangentId t) {
    const auto [p, q] = tangents_.contacts(t);
    bool left = true;
    bool right = true;
    for (const PointId r : hulls_.hull(c).corners) {
      left = left && hulls_.Orient(p, q, r) >= 0;
      right = right && hulls_.Orient(p, q, r) <= 0;
    }
    EXPECT_NE(left, right);
    return left ? 1 : -1;
  }

  CertificateQueue queue_;
  StepMarks marks_;
  KineticHulls hulls_{queue_, marks_};
  TangentTable tangents_{hulls_};
  ClusterId a_ = -1;
  ClusterId b_ = -1;
};

TEST_F(TangentTableOfTwoDiamonds, HasThemInTheOrderOuterOuterInnerInner) {
  const TangentId first = tangents_.First(a_, b_);
  ASSERT_EQ(first, tangents_.First(b_, a_));
  ASSERT_TRUE(tangents_.Exists(first));
  const std::vector<std::array<int, 2>> sides{{1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
  for (std::int32_t i = 0; i < 4; ++i) {
    EXPECT_EQ((std::array{SideOf(a_, first + i), SideOf(b_, first + i)}), sides[Index(i)]) << i;
    EXPECT_TRUE(tangents_.Supports(first + i));
    EXPECT_EQ(TangentTable::Outer(first + i), i < 2);
  }
}

TEST_F(TangentTableOfTwoDiamonds, DirectsHalfTangentsWithTheirOwnHullOnTheLeft) {
  const TangentId first = tangents_.First(a_, b_);
  for (HalfTangentId half = 2 * first; half < 2 * (first + 4); ++half) {
    const ClusterId own = hulls_.ClusterOf(tangents_.Own(half));
    EXPECT_EQ(own, EndOf(half) == 0 ? a_ : b_);
    const bool towards_b = TangentTable::Ahead(half) == (own == a_);
    EXPECT_EQ(SideOf(own, TangentOf(half)), towards_b ? 1 : -1) << half;
  }
}

TEST_F(TangentTableOfTwoDiamonds, OccludesFromATangentThatStartsToOneThatEnds) {
  const TangentId first = tangents_.First(a_, b_);
  const std::array<Arc, 2> arcs = tangents_.ArcsAt(a_, b_);
  EXPECT_EQ(arcs[0].start, 2 * first);
  EXPECT_EQ(arcs[0].end, 2 * (first + 2));
  EXPECT_EQ(arcs[1].start, 2 * (first + 3));
  EXPECT_EQ(arcs[1].end, 2 * (first + 1));
  for (const ClusterId c : {a_, b_}) {
    for (const Arc& arc : tangents_.ArcsAt(c, c == a_ ? b_ : a_)) {
      EXPECT_TRUE(TangentTable::Starts(arc.start));
      EXPECT_FALSE(TangentTable::Starts(arc.end));
      EXPECT_EQ(TangentTable::Ahead(arc.start), TangentTable::Ahead(arc.end));
      EXPECT_EQ(hulls_.ClusterOf(tangents_.Own(arc.start)), c);
    }
  }
}

TEST_F(TangentTableOfTwoDiamonds, OrdersThemAtACornerCounterClockwise) {
  const TangentId first = tangents_.First(a_, b_);
  const HalfTangentId outer = 2 * first;  // both touch the lowest corner of A
  const HalfTangentId inner = 2 * (first + 2);
  ASSERT_EQ(tangents_.Own(outer), tangents_.Own(inner));
  EXPECT_TRUE(tangents_.Before(outer, inner));
  EXPECT_FALSE(tangents_.Before(inner, outer));
  EXPECT_TRUE(tangents_.HasWidth(tangents_.Own(outer), outer, inner));
  EXPECT_FALSE(tangents_.HasWidth(tangents_.Own(outer), inner, outer));
}

TEST_F(TangentTableOfTwoDiamonds, UsesTheSlotOfAHullThatIsGoneAgain) {
  const HalfTangentId count = tangents_.half_count();
  tangents_.Drop(tangents_.First(a_, b_));
  tangents_.RemoveCluster(b_);
  const ClusterId c = AddDiamond(20);
  EXPECT_EQ(tangents_.half_count(), count);
  EXPECT_FALSE(tangents_.Exists(tangents_.First(a_, c)));
  tangents_.Make(a_, c);
  tangents_.CheckTangents(a_, c);
}

}  // namespace
}  // namespace farhorizon::kinetic
