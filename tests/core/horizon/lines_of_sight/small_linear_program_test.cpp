#include "core/horizon/lines_of_sight/small_linear_program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/effort.h"

namespace farhorizon {
namespace {

// The bounds of a box and of planes over it: z <= value + slopes . (x, y).
std::vector<LinearBound> BoundsOf(int planes, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<LinearBound> bounds = {
      {{1, 0, 0}, 1}, {{-1, 0, 0}, 0.5}, {{0, 1, 0}, 1}, {{0, -1, 0}, 1}};
  for (int i = 0; i < planes; ++i) bounds.push_back({{any(random), any(random), 1}, any(random)});
  return bounds;
}

// The greatest z that all bounds leave, by trying a fine grid of (x, y): from below.
double GreatestByTrying(const std::vector<LinearBound>& bounds) {
  constexpr int kSteps = 150;
  double greatest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const double x = -0.5 + 1.5 * i / kSteps;
      const double y = -1 + 2.0 * j / kSteps;
      double z = std::numeric_limits<double>::infinity();
      for (const LinearBound& b : bounds) {
        if (b.weights[2] > 0) z = std::min(z, b.most - b.weights[0] * x - b.weights[1] * y);
      }
      greatest = std::max(greatest, z);
    }
  }
  return greatest;
}

TEST(GreatestLast, IsWithinAllBoundsAndAsGreatAsAny) {
  std::mt19937 random(11);
  for (int round = 0; round < Rounds(60); ++round) {
    const std::vector<LinearBound> bounds = BoundsOf(1 + round % 9, random);
    const std::array<double, 3>& first = bounds[4].weights;
    const std::array<double, 3> best =
        GreatestLast(bounds, {first[0] <= 0 ? 0U : 1U, first[1] <= 0 ? 2U : 3U, 4U});
    for (const LinearBound& b : bounds) {
      EXPECT_LE(b.weights[0] * best[0] + b.weights[1] * best[1] + b.weights[2] * best[2],
                b.most + 1e-9);
    }
    const double tried = GreatestByTrying(bounds);
    EXPECT_GE(best[2], tried - 1e-9);
    EXPECT_LE(best[2], tried + 0.05);  // a step of the grid, at slopes below 1 each
  }
}

}  // namespace
}  // namespace farhorizon
