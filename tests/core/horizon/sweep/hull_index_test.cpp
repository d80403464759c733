#include "core/horizon/sweep/hull_index.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/effort.h"

namespace farhorizon {
namespace {

constexpr std::int32_t kColumns = 150;
constexpr std::int32_t kRows = 100;

class HullIndexTest : public testing::Test {
 protected:
  int Any(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  Point2i AnyPost() { return {Any(0, kColumns - 1), Any(0, kRows - 1)}; }
  std::int32_t AnySlot() { return Any(0, static_cast<int>(hulls_.size()) - 1); }

  void Add() {
    hulls_.emplace_back(AnyPost());
    index_.Add(hulls_.back());
  }
  // By a post nearby, now and then by any post.
  void Grow() {
    const std::int32_t slot = AnySlot();
    ConvexPolygon& hull = hulls_[static_cast<std::size_t>(slot)];
    Point2i p = AnyPost();
    if (Any(0, 9) > 0) {
      p = {std::clamp(hull.least().x + Any(-9, 9), 0, kColumns - 1),
           std::clamp(hull.least().y + Any(-9, 9), 0, kRows - 1)};
    }
    if (!hull.Contains(p)) hull.Extend(p);
    index_.Grow(slot, hull);
  }
  void Drop() {
    const std::int32_t slot = AnySlot();
    std::swap(hulls_[static_cast<std::size_t>(slot)], hulls_.back());
    hulls_.pop_back();
    index_.Drop(slot);
  }

  // Find finds the hulls that a scan of all hulls finds, also for a box that reaches beyond the
  // DEM.
  void ExpectAllThatIntersect(Point2i least, Point2i most) {
    std::vector<std::int32_t> found;
    const std::int32_t last = index_.Find(least, most, [&found](std::int32_t slot) {
      found.push_back(slot);
      return false;
    });
    ASSERT_EQ(last, -1);
    std::vector<std::int32_t> expected;
    for (std::size_t i = 0; i < hulls_.size(); ++i) {
      const ConvexPolygon& hull = hulls_[i];
      const bool apart = hull.most().x < least.x || hull.least().x > most.x ||
                         hull.most().y < least.y || hull.least().y > most.y;
      const auto slot = static_cast<std::int32_t>(i);
      if (!apart) expected.push_back(slot);
    }
    const std::vector<std::int32_t> in_order = found;
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected);
    for (std::size_t i = 0; i < in_order.size(); ++i) {
      const std::int32_t wanted = in_order[i];
      ASSERT_EQ(index_.Find(least, most, [&](std::int32_t slot) { return slot == wanted; }),
                wanted);
    }
  }

  // VisitNearFirst visits each hull once, with its box, where all boxes may be entered; those in
  // boxes that may not are left out.
  void ExpectAllVisited(Point2i from) {
    std::vector<std::int32_t> visited;
    index_.VisitNearFirst(
        from, [](Point2i, Point2i) { return true; },
        [&](std::int32_t slot, Point2i least, Point2i most) {
          const ConvexPolygon& hull = hulls_[static_cast<std::size_t>(slot)];
          EXPECT_EQ(least, hull.least());
          EXPECT_EQ(most, hull.most());
          visited.push_back(slot);
          return true;
        });
    std::sort(visited.begin(), visited.end());
    std::vector<std::int32_t> all(hulls_.size());
    std::iota(all.begin(), all.end(), 0);
    ASSERT_EQ(visited, all);

    std::vector<std::int32_t> reached;
    index_.VisitNearFirst(
        from,
        [&](Point2i least, Point2i most) {
          return least.x <= from.x && from.x <= most.x && least.y <= from.y && from.y <= most.y;
        },
        [&](std::int32_t slot, Point2i, Point2i) {
          reached.push_back(slot);
          return true;
        });
    for (std::size_t i = 0; i < hulls_.size(); ++i) {
      const auto slot = static_cast<std::int32_t>(i);
      const bool holds = hulls_[i].least().x <= from.x && from.x <= hulls_[i].most().x &&
                         hulls_[i].least().y <= from.y && from.y <= hulls_[i].most().y;
      ASSERT_GE(std::count(reached.begin(), reached.end(), slot), holds ? 1 : 0);
    }
  }

  std::mt19937 random_{3};
  std::vector<ConvexPolygon> hulls_;
  HullIndex index_{kColumns, kRows};
};

TEST_F(HullIndexTest, FindsWhatAScanOfAllHullsFinds) {
  for (int round = 0; round < Rounds(5000); ++round) {
    const int step = Any(0, 9);
    if (hulls_.empty() || step < 4) {
      Add();
    } else if (step < 8) {
      Grow();
    } else {
      Drop();
    }
    const Point2i least{Any(-40, kColumns + 40), Any(-40, kRows + 40)};
    ExpectAllThatIntersect(least, {least.x + Any(0, 60), least.y + Any(0, 60)});
    ExpectAllVisited(AnyPost());
    if (HasFatalFailure()) return;
  }
  while (!hulls_.empty()) Drop();
  ExpectAllThatIntersect({0, 0}, {kColumns, kRows});
}

}  // namespace
}  // namespace farhorizon
