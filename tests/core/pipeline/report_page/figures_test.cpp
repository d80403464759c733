#include "core/pipeline/report_page/figures.h"

#include <cmath>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(Figures, GroupDigits) {
  EXPECT_EQ(Grouped(0), "0");
  EXPECT_EQ(Grouped(999), "999");
  EXPECT_EQ(Grouped(1000), "1,000");
  EXPECT_EQ(Grouped(-1234567), "-1,234,567");
}

TEST(Figures, HaveThreeDigits) {
  EXPECT_EQ(ThreeDigits(0), "0");
  EXPECT_EQ(ThreeDigits(0.0123456), "0.0123");
  EXPECT_EQ(ThreeDigits(2), "2.00");
  EXPECT_EQ(ThreeDigits(-12.34), "-12.3");
  EXPECT_EQ(ThreeDigits(236), "236");
  EXPECT_EQ(ThreeDigits(999.7), "1,000");
  EXPECT_EQ(ThreeDigits(9.996), "10.0");
  EXPECT_EQ(ThreeDigits(0.9996), "1.00");
  EXPECT_EQ(ThreeDigits(12345.6), "12,346");
  EXPECT_EQ(Shortest(2), "2");
  EXPECT_EQ(Shortest(0.5), "0.5");
  EXPECT_EQ(Shortest(20000), "20,000");
}

TEST(Figures, ABoundIsNeverRoundedDown) {
  EXPECT_EQ(ThreeDigitsUp(0), "0");
  EXPECT_EQ(ThreeDigitsUp(0.6921), "0.693");
  EXPECT_EQ(ThreeDigitsUp(9.871), "9.88");
  EXPECT_EQ(ThreeDigitsUp(9.991), "10.0");
  EXPECT_EQ(ThreeDigitsUp(164.2), "165");
  EXPECT_EQ(ThreeDigitsUp(1000.1), "1,001");
  for (double value = 1e-7; value < 999; value *= 1.037) {
    EXPECT_GE(std::stod(ThreeDigitsUp(value)), value * (1 - 1e-15)) << value;
    EXPECT_LE(std::stod(ThreeDigitsUp(value)), value * 1.011) << value;
  }
}

TEST(Figures, SayBytesAndShares) {
  EXPECT_EQ(ByteCount(999), "999 B");
  EXPECT_EQ(ByteCount(1000), "1.00 kB");
  EXPECT_EQ(ByteCount(999'499), "999 kB");
  EXPECT_EQ(ByteCount(999'500), "1.00 MB");
  EXPECT_EQ(PercentOf(1, 8), "12.5 %");
  EXPECT_EQ(PercentOf(0, 0), "0 %");
  EXPECT_EQ(Counted(1, "edge", "edges"), "1 edge");
  EXPECT_EQ(Counted(1234, "edge", "edges"), "1,234 edges");
}

}  // namespace
}  // namespace farhorizon
