#include "core/pipeline/option_numbers.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(NumberIn, TakesWhatTheWholeTextWrites) {
  EXPECT_EQ(NumberIn("-9999"), -9999);
  EXPECT_EQ(NumberIn("+5"), 5);
  EXPECT_EQ(NumberIn("-3.4028234663852886e+38"), -std::numeric_limits<float>::max());
  EXPECT_EQ(NumberIn("-inf"), -kInfinity);
  EXPECT_EQ(NumberIn("Infinity"), kInfinity);
  EXPECT_TRUE(std::isnan(NumberIn("NaN").value_or(0)));
  for (const char* text : {"", " ", "-", "+", "+-1", "1 ", " 1", "1m", "0x10", "1,5", "1e999"}) {
    EXPECT_FALSE(NumberIn(text)) << text;
  }
}

TEST(WholeNumberIn, TakesWholeNumbersHoweverTheyAreWritten) {
  for (const char* three : {"3", "3.0", "3e0", "+3", "0.3e1", "3."}) {
    EXPECT_EQ(WholeNumberIn(three), 3) << three;
  }
  EXPECT_EQ(WholeNumberIn("1e6"), 1'000'000);
  EXPECT_EQ(WholeNumberIn("9007199254740993"), 9007199254740993);  // no double
  for (const char* text : {"3.5", "1.5e0", "1e19", "9.3e18", "inf", "nan", "", "3 "}) {
    EXPECT_FALSE(WholeNumberIn(text)) << text;
  }
}

TEST(NumbersIn, SplitsAtCommas) {
  EXPECT_EQ(NumbersIn("-9999,-32767, 0 ,-inf"),
            (std::vector<double>{-9999, -32767, 0, -kInfinity}));
  EXPECT_EQ(NumbersIn("1"), std::vector<double>{1});
  for (const char* text : {"", ",", "1,", ",1", "1,,2", "1 2", "1;2", "1,x"}) {
    EXPECT_FALSE(NumbersIn(text)) << text;
  }
}

TEST(WholeNumbersIn, SplitsAtCommas) {
  EXPECT_EQ(WholeNumbersIn("5000, 1e3,2.0"), (std::vector<std::int64_t>{5000, 1000, 2}));
  for (const char* text : {"", "1,", "1,2.5", "1,nan", "1;2"}) {
    EXPECT_FALSE(WholeNumbersIn(text)) << text;
  }
}

}  // namespace
}  // namespace farhorizon
