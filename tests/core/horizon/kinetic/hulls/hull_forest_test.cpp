// Hulls of moving points, by turns and by the tree of Basch, Guibas and Hershberger, against the
// definition.
#include "core/horizon/kinetic/hulls/hull_forest.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "tests/support/effort.h"

namespace farhorizon::kinetic {
namespace {

/// One cluster, from event to event.
class OneHull {
 public:
  explicit OneHull(HullCertificates certificates) : hulls_(queue_, marks_, certificates) {
    hulls_.AdvanceTo(SweepDepth::At(0));
    c_ = hulls_.NewCluster();
  }
  PointId Add(const MovingPoint& path, std::int64_t end) { return hulls_.Add(c_, path, end, 0); }
  /// Past all events before depth s.
  void SinkTo(std::int64_t s) {
    for (std::optional<SweepDepth> at = queue_.NextDepth();
         at && Compare(*at, SweepDepth::At(s)) < 0; at = queue_.NextDepth()) {
      Advance(*at);
      Restore();
    }
    Advance(SweepDepth::At(s));
  }
  void Remove(PointId p) { hulls_.Remove(p); }
  void Restore() {
    for (const ClusterId c : hulls_.TakeOutdated()) hulls_.UpdateHull(c);
    hulls_.LocateInteriorPoints();
    marks_.ClearDisplaced();
    marks_.ClearStale();
    hulls_.CheckHull(c_);
    hulls_.CheckPoints();
  }
  [[nodiscard]] std::vector<PointId> SortedCorners() const {
    std::vector<PointId> corners = hulls_.corners(c_);
    std::sort(corners.begin(), corners.end());
    return corners;
  }
  /// Those from which an edge leads to another point with all others strictly on its left.
  [[nodiscard]] std::vector<PointId> CornersByDefinition() const {
    std::vector<PointId> corners;
    const auto is_edge = [&](PointId p, PointId q) {
      for (PointId r = 0; r < hulls_.point_count(); ++r) {
        if (r == p || r == q || !hulls_.point(r).alive) continue;
        if (hulls_.Orient(p, q, r) <= 0) return false;
      }
      return true;
    };
    for (PointId p = 0; p < hulls_.point_count(); ++p) {
      for (PointId q = 0; q < hulls_.point_count(); ++q) {
        if (p == q || !hulls_.point(p).alive || !hulls_.point(q).alive || !is_edge(p, q)) continue;
        corners.push_back(p);
        break;
      }
    }
    return corners;
  }
  [[nodiscard]] const KineticHulls& hulls() const { return hulls_; }

 private:
  void Advance(const SweepDepth& now) {
    hulls_.AdvanceTo(now);
    while (const std::optional<Event> event = queue_.PopAt(now)) hulls_.Fail(*event, counts_);
  }

  CertificateQueue queue_;
  StepMarks marks_;
  KineticHulls hulls_;
  SceneCounts counts_;
  ClusterId c_ = -1;
};

class RandomPoints {
 public:
  explicit RandomPoints(std::uint32_t seed) : random_(seed) {}
  std::int64_t Any(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution(low, high)(random_);
  }
  MovingPoint Next(std::int64_t extent) {
    return {Any(-extent, extent) * 64, Any(-50, 50), Any(-extent, extent) * 64, Any(-50, 50), 64};
  }

 private:
  std::mt19937 random_;
};

TEST(HullForest, HasTheCornersThatTheTurnsHave) {
  RandomPoints random(1);
  for (int round = 0; round < Rounds(40); ++round) {
    OneHull turns(HullCertificates::kTurns);
    OneHull tree(HullCertificates::kTree);
    for (std::int64_t n = random.Any(3, 30); n > 0; --n) {
      const MovingPoint path = random.Next(round % 2 == 0 ? 1000 : 8);  // 8: posts in line
      turns.Add(path, kNever);
      tree.Add(path, kNever);
    }
    for (std::int64_t s = 0; s < 400; s += 20) {
      turns.SinkTo(s);
      tree.SinkTo(s);
      turns.Restore();
      tree.Restore();
      ASSERT_EQ(turns.SortedCorners(), tree.SortedCorners()) << "round " << round << ", " << s;
    }
  }
}

// Three that stay far out, so that the hull never has no width.
TEST(HullForest, HasTheCornersOfTheDefinitionWherePointsComeAndGo) {
  RandomPoints random(2);
  for (int round = 0; round < Rounds(10); ++round) {
    OneHull tree(HullCertificates::kTree);
    tree.Add(MovingPoint::Standing(-500, -501), kNever);
    tree.Add(MovingPoint::Standing(502, -503), kNever);
    tree.Add(MovingPoint::Standing(7, 511), kNever);
    tree.Restore();
    std::vector<std::pair<PointId, std::int64_t>> ends;
    for (std::int64_t s = 1; s < 200; ++s) {
      tree.SinkTo(s);
      std::erase_if(ends, [&](const std::pair<PointId, std::int64_t>& point) {
        if (point.second == s) tree.Remove(point.first);
        return point.second == s;
      });
      if (s < 140) {
        const std::int64_t end = s + random.Any(1, 60);
        ends.emplace_back(tree.Add(random.Next(700), end), end);
      }
      tree.Restore();
      ASSERT_EQ(tree.SortedCorners(), tree.CornersByDefinition()) << "round " << round << ", " << s;
    }
    EXPECT_TRUE(ends.empty());
  }
}

TEST(HullForest, CountsTheFailuresOfEveryKindOfCertificate) {
  RandomPoints random(3);
  OneHull tree(HullCertificates::kTree);
  for (int i = 0; i < 60; ++i) tree.Add(random.Next(1000), kNever);
  tree.Restore();
  tree.SinkTo(2000);
  tree.Restore();
  for (const std::int64_t failures : tree.hulls().tree_failures()) EXPECT_GT(failures, 0);
}

}  // namespace
}  // namespace farhorizon::kinetic
