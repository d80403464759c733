#include "core/io/text_grid/text_number.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double Value(std::string_view word) {
  const std::optional<TextNumber> number = ParseNumber(word);
  EXPECT_TRUE(number) << word;
  return number ? number->value : -1;
}

TEST(TextNumber, ReadsWhatProgramsWrite) {
  EXPECT_EQ(Value("12"), 12);
  EXPECT_EQ(Value("+12"), 12);
  EXPECT_EQ(Value("-0012.50"), -12.5);
  EXPECT_EQ(Value(".5"), 0.5);
  EXPECT_EQ(Value("5."), 5);
  EXPECT_EQ(Value("1.5e3"), 1500);
  EXPECT_EQ(Value("1E-2"), 0.01);
  EXPECT_EQ(Value("-3.4028234663852885981170418348451692544e+38"), -3.4028234663852886e38);
  EXPECT_EQ(Value("0.1"), 0.1);
  EXPECT_EQ(Value("1e999"), kInfinity);
  EXPECT_EQ(Value("-1e999"), -kInfinity);
  EXPECT_EQ(Value("1e-999"), 0);
}

TEST(TextNumber, ReadsFortransExponents) {
  EXPECT_EQ(Value("1.5D+02"), 150);
  EXPECT_EQ(Value("1.d3"), 1000);
  EXPECT_FALSE(ParseNumber("D5"));
}

TEST(TextNumber, ReadsInfinitiesAndNans) {
  for (const char* nan : {"nan", "NaN", "-nan", "-1.#IND", "1.#QNAN", "-1.#IND00", "1.#SNAN"}) {
    EXPECT_TRUE(std::isnan(Value(nan))) << nan;
  }
  EXPECT_EQ(Value("inf"), kInfinity);
  EXPECT_EQ(Value("-Infinity"), -kInfinity);
  EXPECT_EQ(Value("1.#INF"), kInfinity);
  EXPECT_EQ(Value("-1.#INF00"), -kInfinity);
}

TEST(TextNumber, RefusesWhatIsLeftOver) {
  for (const char* word :
       {"",     "-",        "+",        "+-5",   "NA",  "null", "#N/A",  "1e5e",
        "0x1F", "1,234.50", "1.234,50", "1,2,3", "12,", "1 2",  "1.2.3", "12m",
        "--5",  "nan(1)",   "1.#FOO",   "1-300", "*",   "1d",   "1_000", "1'000"}) {
    EXPECT_FALSE(ParseNumber(word)) << word;
  }
  EXPECT_FALSE(ParseNumber(std::string(TextWords::kMaxWord, '1')));
}

TEST(TextNumber, TellsWholeNumbersAndPoints) {
  EXPECT_TRUE(ParseNumber("-7")->whole);
  EXPECT_FALSE(ParseNumber("7.0")->whole);
  EXPECT_TRUE(ParseNumber("7.0")->point);
  EXPECT_FALSE(ParseNumber("7e1")->point);
}

TEST(TextNumber, TellsWhatACommaCanBe) {
  EXPECT_EQ(Value("200,50"), 200.5);
  EXPECT_EQ(ParseNumber("200,50")->comma, CommaUse::kDecimal);
  EXPECT_EQ(ParseNumber("1,234")->comma, CommaUse::kEither);
  EXPECT_EQ(ParseNumber("-1,234")->comma, CommaUse::kEither);
  EXPECT_EQ(ParseNumber("0,125")->comma, CommaUse::kDecimal);
  EXPECT_EQ(ParseNumber("1234,500")->comma, CommaUse::kDecimal);
  EXPECT_EQ(ParseNumber("1,234e2")->comma, CommaUse::kDecimal);
  EXPECT_EQ(ParseNumber("-,5")->value, -0.5);
}

bool Decimal(std::initializer_list<const char*> words) {
  CommaRule rule;
  for (const char* word : words) rule.Take(*ParseNumber(word), {word, 1, 1});
  return rule.Judge().has_value();
}

TEST(CommaRule, WantsTheTextToDecide) {
  EXPECT_TRUE(Decimal({"12", "13.5"}));
  EXPECT_TRUE(Decimal({"12", "13,5"}));
  EXPECT_TRUE(Decimal({"1,234", "0,500"}));
  EXPECT_FALSE(Decimal({"1,234", "987"}));
  EXPECT_FALSE(Decimal({"1,234", "987.5"}));
  EXPECT_FALSE(Decimal({"0,5", "0.5"}));
}

}  // namespace
}  // namespace farhorizon
