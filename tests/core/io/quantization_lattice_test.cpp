#include "core/io/quantization_lattice.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(ChooseLattice, StepIsThePowerOfTwoAtOrBelowTheWish) {
  const std::vector<Enu> points = {{-100, -50, 0}, {100, 50, 30}};
  EXPECT_EQ(ChooseLattice(points, 0.7).step_m, 0.5);
  EXPECT_EQ(ChooseLattice(points, 0.5).step_m, 0.5);
  EXPECT_EQ(ChooseLattice(points, 8.1).step_m, 8);
}

TEST(ChooseLattice, CoversItsPointsWithOriginsThatAreMultiplesOfTheStep) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(-20000, 20000);
  for (int i = 0; i < 200; ++i) {
    std::vector<Enu> points;
    for (int k = 0; k < 5; ++k) points.push_back({draw(random), draw(random), draw(random) / 10});
    const QuantizationLattice lattice = ChooseLattice(points, std::abs(draw(random)) / 1000);
    EXPECT_LE(lattice.bits, kMaxLatticeBits);
    for (const double origin : lattice.origin) {
      EXPECT_EQ(std::remainder(origin, lattice.step_m), 0);
    }
    for (const Enu& p : points) {
      const Enu snapped = SnapToLattice(p, lattice);
      EXPECT_LE(std::abs(snapped.east - p.east), lattice.step_m / 2);
      EXPECT_LE(std::abs(snapped.north - p.north), lattice.step_m / 2);
      EXPECT_LE(std::abs(snapped.up - p.up), lattice.step_m / 2);
    }
  }
}

TEST(ChooseLattice, TakesNoMoreBitsThanDracoCodesWellAndNoMoreThanItNeeds) {
  const std::vector<Enu> wide = {{0, 0, 0}, {30000, 0, 0}};
  EXPECT_EQ(ChooseLattice(wide, 0.001).bits, 19);
  EXPECT_EQ(ChooseLattice(wide, 0.001).step_m, 0.0625);  // 480,000 steps; half would take 960,000
  EXPECT_EQ(ChooseLattice({{0, 0, 0}, {7, 0, 0}}, 1).bits, 3);
  EXPECT_EQ(ChooseLattice({{5, 5, 5}}, 1).bits, 1);
}

TEST(ChooseLattice, FarFromTheOriginTheStepGrowsUntilFloatIsExact) {
  const QuantizationLattice lattice = ChooseLattice({{6e6, 0, 0}, {6e6 + 100, 0, 0}}, 1e-3);
  EXPECT_EQ(lattice.step_m, 0.5);  // 12e6 halves lie below 2^24, 24e6 quarters do not
}

TEST(LatticeBoxOf, HoldsTheNumbersOfAllPoints) {
  const QuantizationLattice lattice = {.origin = {-8, 0, 16}, .step_m = 0.5, .bits = 8};
  const LatticeBox box = LatticeBoxOf({{-7, 3, 16}, {-8, 4, 17}, {-7.5, 2.1, 16.5}}, lattice);
  EXPECT_EQ(box.least, (std::array<double, 3>{0, 4, 0}));
  EXPECT_EQ(box.greatest, (std::array<double, 3>{2, 8, 2}));
  EXPECT_EQ(LatticeBoxOf({}, lattice).greatest, (std::array<double, 3>{0, 0, 0}));
}

}  // namespace
}  // namespace farhorizon
