#include "core/horizon/sweep/edge_occlusion.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

struct Scene {
  Point2i low;
  Point2i high;
  ConvexPolygon own;  // contains high, not low; may be empty
  std::vector<ConvexPolygon> others;
};

int RandomIn(std::mt19937& random, int least, int most) {
  return least + static_cast<int>(random() % static_cast<unsigned>(most - least + 1));
}

ConvexPolygon RandomHull(std::mt19937& random, Point2i center, int size,
                         std::vector<Point2i> corners = {}) {
  for (int i = RandomIn(random, 1, 6); i > 0; --i) {
    corners.push_back(
        {center.x + RandomIn(random, -size, size), center.y + RandomIn(random, -size, size)});
  }
  return ConvexPolygon::HullOf(corners);
}

Scene RandomScene(std::mt19937& random) {
  Scene scene;
  scene.low = {0, 0};
  do {
    scene.high = {RandomIn(random, -1, 1), RandomIn(random, -1, 1)};
  } while (scene.high == scene.low);
  const Point2i ahead{9 * scene.high.x, 9 * scene.high.y};
  scene.own = RandomHull(random, ahead, 9, {scene.high});
  if (scene.own.Contains(scene.low) || random() % 4 == 0) scene.own = {};
  for (int i = RandomIn(random, 0, 4); i > 0; --i) {
    const ConvexPolygon hull = RandomHull(
        random, {RandomIn(random, -12, 12), RandomIn(random, -12, 12)}, RandomIn(random, 1, 5));
    if (scene.own.corners().empty() || !hull.Meets(scene.own)) scene.others.push_back(hull);
  }
  return scene;
}

// Whether the line in `direction` through t = n / d of the way meets a hull: corners on both sides.
bool MeetsLine(const ConvexPolygon& hull, const Scene& scene, int n, int d, Point2i direction) {
  bool left = false;
  bool right = false;
  for (const Point2i p : hull.corners()) {
    const int x = d * (p.x - scene.low.x) - n * (scene.high.x - scene.low.x);
    const int y = d * (p.y - scene.low.y) - n * (scene.high.y - scene.low.y);
    const int cross = direction.x * y - direction.y * x;
    left = left || cross >= 0;
    right = right || cross <= 0;
  }
  return left && right;
}

// Whether some line of a fine sample, through the edge and in a direction of the wedge, meets no
// hull.
bool SomeLineIsFree(const Scene& scene, const std::optional<FaceWedge>& wedge) {
  constexpr int kSteps = 8;
  constexpr int kFine = 24;
  const auto cross = [](const ShortVector& a, Point2i b) { return a.x * b.y - a.y * b.x; };
  const ShortVector along{scene.high.x - scene.low.x, scene.high.y - scene.low.y};
  for (int n = 1; n < kSteps; ++n) {
    for (int x = -kFine; x <= kFine; ++x) {
      for (int y = -kFine; y <= kFine; ++y) {
        const Point2i direction{x, y};
        if (cross(along, direction) <= 0) continue;
        if (wedge && (cross(wedge->first, direction) <= 0 || cross(wedge->last, direction) >= 0)) {
          continue;
        }
        const auto meets = [&](const ConvexPolygon& hull) {
          return !hull.corners().empty() && MeetsLine(hull, scene, n, kSteps, direction);
        };
        if (!meets(scene.own) && std::none_of(scene.others.begin(), scene.others.end(), meets)) {
          return true;
        }
      }
    }
  }
  return false;
}

TEST(EdgeOcclusion, OccludesAllOnlyWhereEveryLineMeetsAHull) {
  std::mt19937 random(11);
  int complete = 0;
  int occluded = 0;
  for (int round = 0; round < 12000; ++round) {
    const Scene scene = RandomScene(random);
    const Point3i low{scene.low.x, scene.low.y, 0};
    const Point3i high{scene.high.x, scene.high.y, RandomIn(random, 0, 3)};
    const Point3i left{-scene.high.y, scene.high.x, RandomIn(random, -4, 2)};
    const Point3i right{scene.high.y, -scene.high.x, RandomIn(random, -4, 2)};
    const std::optional<FaceWedge> wedge = WedgeOf(low, high, left, right);
    EdgeOcclusion occlusion(scene.low, scene.high, wedge);
    if (!scene.own.corners().empty()) occlusion.Add(scene.own);
    for (const ConvexPolygon& hull : scene.others) occlusion.Add(hull);
    const bool is_free = SomeLineIsFree(scene, wedge);
    occluded += static_cast<int>(!is_free);
    if (!occlusion.IsOccluded()) continue;
    ++complete;
    ASSERT_FALSE(is_free) << "round " << round;
  }
  EXPECT_GT(complete, 300);
  // Hulls each of which occludes part of the edge only are left to the exact decision.
  EXPECT_GT(complete, occluded / 2);
}

// Both ends of a virtual occluder are in one hull, so it occludes nothing that the hull does not.
TEST(EdgeOcclusion, VirtualOccludersLieInTheHulls) {
  std::mt19937 random(12);
  std::size_t virtual_occluders = 0;
  for (int round = 0; round < 1000; ++round) {
    const Scene scene = RandomScene(random);
    EdgeOcclusion occlusion(scene.low, scene.high, std::nullopt);
    if (!scene.own.corners().empty()) occlusion.Add(scene.own);
    for (const ConvexPolygon& hull : scene.others) occlusion.Add(hull);
    std::vector<Segment> found;
    occlusion.AppendVirtualOccluders(7, found);
    for (const Segment& virtual_occluder : found) {
      EXPECT_EQ(virtual_occluder.a.z, 7);
      EXPECT_EQ(virtual_occluder.b.z, 7);
      const auto has_both = [&virtual_occluder](const ConvexPolygon& hull) {
        return !hull.corners().empty() &&
               hull.Contains({virtual_occluder.a.x, virtual_occluder.a.y}) &&
               hull.Contains({virtual_occluder.b.x, virtual_occluder.b.y});
      };
      ASSERT_TRUE(has_both(scene.own) ||
                  std::any_of(scene.others.begin(), scene.others.end(), has_both));
    }
    virtual_occluders += found.size();
  }
  EXPECT_GT(virtual_occluders, 1000u);
}

}  // namespace
}  // namespace farhorizon
