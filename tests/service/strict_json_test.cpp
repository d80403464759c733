#include "service/strict_json.h"

#include <string>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(StrictJson, IsBoundedInDepthAndStrictInNames) {
  EXPECT_TRUE(ParseStrictJson(R"({"a": [1, {"b": 2}], "c": {"b": 1}})"));
  EXPECT_FALSE(ParseStrictJson(std::string(100'000, '[')));
  EXPECT_FALSE(ParseStrictJson(std::string(100, '[') + std::string(100, ']')));
  EXPECT_FALSE(ParseStrictJson(R"({"a": 1, "a": 2})"));
  EXPECT_FALSE(ParseStrictJson("{\"a\": NaN}"));
  EXPECT_FALSE(ParseStrictJson("\xFF"));
  EXPECT_FALSE(ParseStrictJson(""));
  EXPECT_FALSE(ParseStrictJson(R"({"a": "\u0000"})"));
  EXPECT_FALSE(ParseStrictJson(R"({"a\u0000b": 1})"));
  EXPECT_FALSE(ParseStrictJson(R"(["\u0000"])"));
}

}  // namespace
}  // namespace farhorizon
