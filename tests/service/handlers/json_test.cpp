#include "service/handlers/json.h"

#include <string>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(ClientJson, IsBoundedInDepthAndStrictInNames) {
  EXPECT_TRUE(ParseClientJson(R"({"a": [1, {"b": 2}], "c": {"b": 1}})"));
  EXPECT_FALSE(ParseClientJson(std::string(100'000, '[')));
  EXPECT_FALSE(ParseClientJson(std::string(100, '[') + std::string(100, ']')));
  EXPECT_FALSE(ParseClientJson(R"({"a": 1, "a": 2})"));
  EXPECT_FALSE(ParseClientJson("{\"a\": NaN}"));
  EXPECT_FALSE(ParseClientJson("\xFF"));
  EXPECT_FALSE(ParseClientJson(""));
}

}  // namespace
}  // namespace farhorizon
