#include "core/geometry/convex_polygon.h"

#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

std::vector<Point2i> RandomPoints(std::mt19937& random, int most, int size) {
  std::vector<Point2i> points(1 + random() % static_cast<unsigned>(most));
  for (Point2i& p : points) {
    p = {static_cast<int>(random() % static_cast<unsigned>(size)),
         static_cast<int>(random() % static_cast<unsigned>(size))};
  }
  return points;
}

std::int64_t TurnAt(Point2i o, Point2i a, Point2i b) {
  return std::int64_t{a.x - o.x} * (b.y - o.y) - std::int64_t{a.y - o.y} * (b.x - o.x);
}

// p is in the hull exactly if it is in a triangle, or a segment, of three of the points:
// Carathéodory.
bool InHull(const std::vector<Point2i>& points, Point2i p) {
  for (const Point2i a : points) {
    for (const Point2i b : points) {
      for (const Point2i c : points) {
        const std::int64_t u = TurnAt(a, b, p);
        const std::int64_t v = TurnAt(b, c, p);
        const std::int64_t w = TurnAt(c, a, p);
        if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) continue;
        const auto [x0, x1] = std::minmax({a.x, b.x, c.x});
        const auto [y0, y1] = std::minmax({a.y, b.y, c.y});
        if (p.x >= x0 && p.x <= x1 && p.y >= y0 && p.y <= y1) return true;
      }
    }
  }
  return false;
}

// Corners from the least on.
std::vector<Point2i> RingOf(const ConvexPolygon& polygon) {
  std::vector<Point2i> ring = polygon.corners();
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  return ring;
}

TEST(ConvexPolygon, ExtendsToTheHullOfAllPointsItWasGiven) {
  std::mt19937 random(7);
  for (int round = 0; round < 3000; ++round) {
    const int size = 3 + static_cast<int>(random() % 30);
    std::vector<Point2i> points = RandomPoints(random, 30, size);
    ConvexPolygon grown(points.front());
    std::vector<Point2i> so_far;
    for (const Point2i p : points) {
      so_far.push_back(p);
      if (!grown.Contains(p)) grown.Extend(p);
      const ConvexPolygon hull = ConvexPolygon::HullOf(so_far);
      ASSERT_EQ(RingOf(grown), RingOf(hull));
      ASSERT_EQ(grown.least(), hull.least());
      ASSERT_EQ(grown.most(), hull.most());
    }
  }
}

TEST(ConvexPolygon, ContainsAndHasInRowsThePostsOfTheDefinition) {
  std::mt19937 random(6);
  for (int round = 0; round < 400; ++round) {
    std::vector<Point2i> points = RandomPoints(random, 7, 8);
    const std::vector<Point2i> original = points;
    const ConvexPolygon hull = ConvexPolygon::HullOf(points);
    std::set<Point2i> covered;
    hull.ForEachRow([&](std::int32_t row, std::int32_t first, std::int32_t last) {
      for (std::int32_t x = first; x <= last; ++x) covered.insert({x, row});
    });
    for (int x = -1; x <= 8; ++x) {
      for (int y = -1; y <= 8; ++y) {
        const bool inside = InHull(original, {x, y});
        ASSERT_EQ(hull.Contains({x, y}), inside);
        ASSERT_EQ(covered.count({x, y}) == 1, inside);
      }
    }
  }
}

// Convex sets are disjoint exactly if a line along one through two of their corners, or
// perpendicular to one, separates them.
bool Separable(const std::vector<Point2i>& a, const std::vector<Point2i>& b) {
  std::vector<Point2i> normals;
  std::vector<Point2i> all = a;
  all.insert(all.end(), b.begin(), b.end());
  for (const Point2i p : all) {
    for (const Point2i q : all) {
      normals.push_back({q.x - p.x, q.y - p.y});
      normals.push_back({p.y - q.y, q.x - p.x});
    }
  }
  for (const Point2i n : normals) {
    const auto along = [n](Point2i p) { return n.x * p.x + n.y * p.y; };
    int most_a = along(a[0]);
    for (const Point2i p : a) most_a = std::max(most_a, along(p));
    int least_b = along(b[0]);
    for (const Point2i p : b) least_b = std::min(least_b, along(p));
    if (most_a < least_b) return true;
  }
  return false;
}

TEST(ConvexPolygon, MeetsUnlessALineSeparates) {
  std::mt19937 random(7);
  for (int round = 0; round < 5000; ++round) {
    std::vector<Point2i> a = RandomPoints(random, 5, 9);
    std::vector<Point2i> b = RandomPoints(random, 5, 9);
    const bool separable = Separable(a, b);
    const ConvexPolygon hull_a = ConvexPolygon::HullOf(a);
    const ConvexPolygon hull_b = ConvexPolygon::HullOf(b);
    ASSERT_EQ(hull_a.Meets(hull_b), !separable) << "round " << round;
    ASSERT_EQ(hull_b.Meets(hull_a), !separable);
  }
}

TEST(ConvexPolygon, IsBetweenTheTangentsOfItsSilhouette) {
  std::mt19937 random(8);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Point2i> points = RandomPoints(random, 6, 9);
    const ConvexPolygon hull = ConvexPolygon::HullOf(points);
    const Point2i eye{static_cast<int>(random() % 15) - 3, static_cast<int>(random() % 15) - 3};
    if (hull.corners().size() < 2 || hull.Contains(eye)) continue;
    const ConvexPolygon::Silhouette seen = hull.SilhouetteFrom(eye);
    for (const Point2i p : hull.corners()) {
      ASSERT_GE(TurnAt(eye, seen.right, p), 0);
      ASSERT_LE(TurnAt(eye, seen.left, p), 0);
    }
  }
}

}  // namespace
}  // namespace farhorizon
