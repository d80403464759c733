#include "core/io/dem/values/fill_cliffs.h"

#include <cmath>

#include "tests/support/dem_fixture.h"

namespace farhorizon {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class FillCliffs : public DemFixture {
 protected:
  static constexpr int kSide = 40;

  // Hills from `low`, 300 m high, whose steps are 9 m on average.
  static std::vector<double> Hills(double low) {
    std::vector<double> heights;
    for (int r = 0; r < kSide; ++r) {
      for (int c = 0; c < kSide; ++c) {
        heights.push_back(std::round(low + 150 + 100 * std::sin(c / 6.0) * std::cos(r / 7.0) +
                                     50 * std::cos(c / 9.0 + r / 5.0)));
      }
    }
    return heights;
  }
  // `heights` with `value` outside a square that stands on its corner, as gdalwarp leaves it.
  static std::vector<double> Turned(std::vector<double> heights, double value) {
    for (int r = 0; r < kSide; ++r) {
      for (int c = 0; c < kSide; ++c) {
        if (std::abs(r - 20) + std::abs(c - 20) > 24) At(heights, c, r) = value;
      }
    }
    return heights;
  }
  static double& At(std::vector<double>& heights, int column, int row) {
    return heights[static_cast<std::size_t>(row * kSide + column)];
  }
  Dem ReadHeights(const std::vector<double>& heights, const std::string& type = "Float32") {
    return MustRead({.columns = kSide, .rows = kSide, .type = type, .values = heights});
  }
  static bool Said(const Dem& dem) {
    return ::testing::Matches(Contains("cliffs-around-value"))(Codes(dem));
  }
};

TEST_F(FillCliffs, ACollarOfZerosIsSaidAndKept) {
  const Dem dem = ReadHeights(Turned(Hills(700), 0));
  EXPECT_EQ(PostsWithoutData(dem), 0);
  ASSERT_TRUE(Said(dem));
  EXPECT_THAT(dem.assumptions.back().text, HasSubstr("exactly 0 "));
  EXPECT_THAT(dem.assumptions.back().text, HasSubstr("--nodata=0"));
}

TEST_F(FillCliffs, ACollarOfAnotherConstantIsSaid) {
  EXPECT_TRUE(Said(ReadHeights(Turned(Hills(700), -1))));
  EXPECT_TRUE(Said(ReadHeights(Turned(Hills(700), 2000))));
  EXPECT_TRUE(Said(ReadHeights(Turned(Hills(1500), 255), "Int16")));
  EXPECT_TRUE(Said(ReadHeights(Turned(Hills(200), -99))));
}

TEST_F(FillCliffs, NamingItsValueEndsThat) {
  const Dem dem = MustRead(
      {.columns = kSide, .rows = kSide, .type = "Float32", .values = Turned(Hills(700), 0)},
      {.nodata = {0}});
  EXPECT_GT(PostsWithoutData(dem), 100);
  EXPECT_FALSE(Said(dem));
}

TEST_F(FillCliffs, AHoleOfAConstantInsideIsSaid) {
  std::vector<double> heights = Hills(700);
  At(heights, 20, 20) = 0;
  EXPECT_TRUE(Said(ReadHeights(heights)));
  heights = Hills(700);
  for (int c = 10; c < 15; ++c) At(heights, c, 20) = 13;
  EXPECT_TRUE(Said(ReadHeights(heights)));
}

TEST_F(FillCliffs, GroundWithoutCliffsToOneValueIsNotSaid) {
  EXPECT_FALSE(Said(ReadHeights(Hills(0))));
  EXPECT_FALSE(Said(ReadHeights(Hills(700))));
  // One blunder of a survey is no fill.
  std::vector<double> pit = Hills(700);
  At(pit, 20, 20) = 400;
  EXPECT_FALSE(Said(ReadHeights(pit)));
}

// The sea where hills would go below it: a shore.
TEST_F(FillCliffs, ASeaWithItsShoreIsNotSaid) {
  std::vector<double> coast = Hills(-150);
  for (double& height : coast) height = std::max(height, 0.0);
  EXPECT_FALSE(Said(ReadHeights(coast)));
  // Half of its shore is a cliff of 60 m.
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide / 2; ++c) {
      if (At(coast, c, r) > 0) At(coast, c, r) += 60;
    }
  }
  EXPECT_FALSE(Said(ReadHeights(coast)));
}

TEST_F(FillCliffs, ALakeAndAQuayAreNotSaid) {
  std::vector<double> lake = Hills(700);
  for (double& height : lake) height = std::max(height, 800.0);
  EXPECT_FALSE(Said(ReadHeights(lake)));
  // A canal between quays of 3 m in a plain.
  std::vector<double> plain(kSide * kSide);
  for (std::size_t i = 0; i < plain.size(); ++i) plain[i] = 4 + 0.1 * static_cast<double>(i % 3);
  for (int c = 0; c < kSide; ++c) At(plain, c, 11) = At(plain, c, 12) = 1;
  EXPECT_FALSE(Said(ReadHeights(plain)));
}

// The steps of the ground are what a cliff is measured by: in feet they are as many as in metres.
TEST_F(FillCliffs, StepsAreInMetres) {
  const auto read = [&](double low, const char* unit) {
    return Said(MustRead({.columns = kSide,
                          .rows = kSide,
                          .type = "Float32",
                          .values = Turned(std::vector<double>(kSide * kSide, low), 0),
                          .unit = unit}));
  };
  EXPECT_TRUE(read(15, ""));
  EXPECT_FALSE(read(15, "ft"));  // 4.6 m
  EXPECT_FALSE(read(9, ""));
}

}  // namespace
}  // namespace farhorizon
