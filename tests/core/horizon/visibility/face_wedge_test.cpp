#include "core/horizon/visibility/face_wedge.h"

#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "core/geometry/direction.h"
#include "core/geometry/plan.h"

namespace farhorizon {
namespace {

// The rise of the face through low, high and third along `direction`, times twice the face's area:
// from the normal of its plane.
Int128 Climb(const Point3i& low, const Point3i& high, const Point3i& third,
             const ShortVector& direction) {
  const std::int64_t ux = high.x - low.x;
  const std::int64_t uy = high.y - low.y;
  const std::int64_t uz = std::int64_t{high.z} - low.z;
  const std::int64_t vx = third.x - low.x;
  const std::int64_t vy = third.y - low.y;
  const std::int64_t vz = std::int64_t{third.z} - low.z;
  const Int128 area = Int128{ux} * vy - Int128{uy} * vx;
  const Int128 climb_x = Int128{uz} * vy - Int128{uy} * vz;
  const Int128 climb_y = Int128{ux} * vz - Int128{uz} * vx;
  const Int128 climb = climb_x * direction.x + climb_y * direction.y;
  return area > 0 ? climb : -climb;
}

struct Ridge {
  Point3i low{0, 0, 0};
  Point3i high;
  std::optional<Point3i> left;
  std::optional<Point3i> right;
};

// Whether a line through the edge in `direction`, which points to its left, has ground of a face
// above it right beside the edge.
bool IsOccludedByFaces(const Ridge& ridge, const ShortVector& direction) {
  const ShortVector back = -direction;
  return (ridge.left && Climb(ridge.low, ridge.high, *ridge.left, direction) > 0) ||
         (ridge.right && Climb(ridge.low, ridge.high, *ridge.right, back) > 0);
}

// An edge that may be a point in plan and may have two faces, one or none.
Ridge AnyRidge(std::mt19937& random) {
  const auto any = [&random](int least, int most) {
    return least + static_cast<int>(random() % static_cast<unsigned>(most - least + 1));
  };
  Ridge ridge;
  ridge.high = {any(-2, 2), any(-2, 2), any(1, 4)};
  const ShortVector along{ridge.high.x, ridge.high.y};
  for (std::optional<Point3i>* third : {&ridge.left, &ridge.right}) {
    if (random() % 8 == 0) continue;
    const Point3i p{any(-2, 2), any(-2, 2), any(-6, 6)};
    const int side = CrossSign(along, {p.x, p.y});
    if (side == (third == &ridge.left ? 1 : -1)) *third = p;
  }
  return ridge;
}

// Small vectors have directions in the wedge exactly where no face occludes them.
void ExpectTheFreeOnes(const Ridge& ridge, const FaceWedge& wedge) {
  const ShortVector along{ridge.high.x, ridge.high.y};
  for (int x = -7; x <= 7; ++x) {
    for (int y = -7; y <= 7; ++y) {
      const ShortVector direction{x, y};
      if (CrossSign(along, direction) <= 0) continue;
      ASSERT_EQ(IsOccludedByFaces(ridge, direction),
                CrossSign(wedge.first, direction) < 0 || CrossSign(direction, wedge.last) < 0)
          << x << ", " << y;
    }
  }
}

TEST(FaceWedge, IsWhatTheFacesDoNotOcclude) {
  std::mt19937 random(3);
  int wedges = 0;
  int without = 0;
  for (int round = 0; round < 5000; ++round) {
    const Ridge ridge = AnyRidge(random);
    if (ridge.high.x == 0 && ridge.high.y == 0) continue;
    if (!ridge.left && !ridge.right) continue;
    const auto wedge = random() % 2 == 0 ? WedgeOf(ridge.low, ridge.high, ridge.left, ridge.right)
                                         : WedgeOf(ridge.low, ridge.high, ridge.right, ridge.left);
    if (wedge) ExpectTheFreeOnes(ridge, *wedge);
    // Without a wedge the contours of both faces have one direction, at most.
    if (!wedge) {
      ASSERT_TRUE(ridge.left && ridge.right);
      ASSERT_LE(RidgeSign(ridge.low, ridge.high, *ridge.right, *ridge.left), 0);
    }
    ++(wedge ? wedges : without);
  }
  EXPECT_GT(wedges, 1000);
  EXPECT_GT(without, 200);
}

TEST(FaceWedge, OfAHorizontalEdgeIsNone) {
  EXPECT_FALSE(WedgeOf({0, 0, 5}, {1, 0, 5}, Point3i{0, 1, 2}, Point3i{1, -1, 3}));
}

}  // namespace
}  // namespace farhorizon
