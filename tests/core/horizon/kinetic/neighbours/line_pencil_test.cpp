// The lines through a corner that hulls leave free, against the definition at sampled directions.
#include "core/horizon/kinetic/neighbours/line_pencil.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/kinetic/hulls/hull_location.h"
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "tests/support/effort.h"

namespace farhorizon::kinetic {
namespace {

struct Step {
  std::int64_t x = 0;
  std::int64_t y = 0;
};
std::int64_t CrossProduct(Step a, Step b) { return a.x * b.y - a.y * b.x; }

/// A triangle at the origin, and others around it; all paths have d = 1.
class Triangles {
 public:
  explicit Triangles(std::mt19937& random) : random_(random) {
    hulls_.AdvanceTo(SweepDepth::At(0));
    own_ = Add({0, 0}, 3, 0);
  }
  std::int64_t Any(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution(low, high)(random_);
  }
  /// Three corners around a place, where no hull is yet; -1 where there is no room.
  ClusterId Add(Step at, std::int64_t size, std::int64_t speed) {
    const ClusterId c = hulls_.NewCluster();
    const std::array corners{Step{-size - Any(0, size), -size}, Step{size, -Any(0, size)},
                             Step{Any(-size, size), size + Any(0, 2)}};
    for (const Step& corner : corners) {
      hulls_.Add(c, {at.x + corner.x, Any(-speed, speed), at.y + corner.y, Any(-speed, speed), 1},
                 kNever, 0);
    }
    hulls_.UpdateHull(c);
    for (const ClusterId other : clusters_) {
      if (HullsIntersect(hulls_, c, other)) return -1;
    }
    clusters_.push_back(c);
    return c;
  }
  /// Whether some line that touches the own hull at p, between its edges there, meets no other.
  [[nodiscard]] bool IsFreeByDefinition(PointId p, std::int64_t s) const {
    const auto place = [&](PointId q) {
      const MovingPoint at = hulls_.path(q).At(s);
      return Step{at.x, at.y};
    };
    const auto from_p = [&](PointId q) {
      return Step{place(q).x - place(p).x, place(q).y - place(p).y};
    };
    const Step to_prev = from_p(hulls_.point(p).prev);
    const Step first{-to_prev.x, -to_prev.y};
    const Step last = from_p(hulls_.point(p).next);
    std::vector<Step> directions{first, last};
    for (const ClusterId c : clusters_) {
      if (c == own_) continue;
      for (const PointId q : hulls_.corners(c)) {
        Step direction = from_p(q);
        if (CrossProduct(first, direction) < 0) direction = {-direction.x, -direction.y};
        if (CrossProduct(first, direction) > 0 && CrossProduct(direction, last) > 0)
          directions.push_back(direction);
      }
    }
    std::sort(directions.begin(), directions.end(),
              [](Step a, Step b) { return CrossProduct(a, b) > 0; });
    for (std::size_t i = 1; i < directions.size(); ++i) {
      const Step a = directions[i - 1];
      const Step b = directions[i];
      const Step between{a.x + b.x, a.y + b.y};
      if (CrossProduct(a, b) == 0) continue;
      const bool meets = std::any_of(clusters_.begin(), clusters_.end(), [&](ClusterId c) {
        if (c == own_) return false;
        int sides = 0;
        for (const PointId q : hulls_.corners(c))
          sides |= CrossProduct(between, from_p(q)) > 0 ? 1 : 2;
        return sides == 3;
      });
      if (!meets) return true;
    }
    return false;
  }
  /// The others, all of them, in a pencil at p.
  [[nodiscard]] LinePencil<KineticHulls> PencilAt(PointId p) const {
    LinePencil<KineticHulls> pencil(hulls_, hulls_.path(p), hulls_.path(hulls_.point(p).prev),
                                    hulls_.path(hulls_.point(p).next));
    for (const ClusterId c : clusters_) {
      if (c != own_) pencil.Add(c);
    }
    return pencil;
  }
  [[nodiscard]] const std::vector<PointId>& OwnCorners() const { return hulls_.corners(own_); }

 private:
  std::mt19937& random_;
  CertificateQueue queue_;
  StepMarks marks_;
  KineticHulls hulls_{queue_, marks_};
  std::vector<ClusterId> clusters_;
  ClusterId own_ = -1;
};

TEST(LinePencil, HasAGapExactlyWhereALineIsFree) {
  std::mt19937 random(1);
  int free = 0;
  int covered = 0;
  for (int round = 0; round < Rounds(400); ++round) {
    Triangles triangles(random);
    const std::int64_t extent = round % 2 == 0 ? 40 : 14;  // 14: many are in line
    for (std::int64_t n = triangles.Any(1, 40); n > 0; --n) {
      triangles.Add({triangles.Any(-extent, extent), triangles.Any(-extent, extent)},
                    triangles.Any(1, 4), 0);
    }
    for (const PointId p : triangles.OwnCorners()) {
      const bool has_gap = triangles.PencilAt(p).FindGap().has_value();
      ASSERT_EQ(has_gap, triangles.IsFreeByDefinition(p, 0)) << "round " << round;
      ++(has_gap ? free : covered);
    }
  }
  EXPECT_GT(free, Rounds(100));
  EXPECT_GT(covered, Rounds(100));
}

TEST(LinePencil, LeavesNoLineFreeUntilItsCoverFails) {
  std::mt19937 random(2);
  int held = 0;
  for (int round = 0; round < Rounds(400); ++round) {
    Triangles triangles(random);
    for (int n = 0; n < 60; ++n) {
      triangles.Add({triangles.Any(-400, 400), triangles.Any(-400, 400)}, triangles.Any(10, 40), 3);
    }
    for (const PointId p : triangles.OwnCorners()) {
      LinePencil<KineticHulls> pencil = triangles.PencilAt(p);
      if (pencil.FindGap()) continue;
      constexpr std::int64_t kEnd = 40;
      const std::optional<SweepDepth> failure = pencil.FailureBefore(kEnd);
      for (std::int64_t s = 0; s < kEnd; ++s) {
        if (failure && Compare(*failure, SweepDepth::At(s)) <= 0) break;
        ASSERT_FALSE(triangles.IsFreeByDefinition(p, s)) << "round " << round << ", depth " << s;
        ++held;
      }
    }
  }
  EXPECT_GT(held, Rounds(400));
}

}  // namespace
}  // namespace farhorizon::kinetic
