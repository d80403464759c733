#include "core/geo/short_text.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(ShortText, LeavesShortTextsAsTheyAre) {
  EXPECT_EQ(ShortText("", 3), "");
  EXPECT_EQ(ShortText("abc", 3), "abc");
  EXPECT_EQ(ShortText("a\nb", 3), "a b");
}

TEST(ShortText, EndsWithAWholeCharacter) {
  EXPECT_EQ(ShortText("abcd", 3), "abc...");
  EXPECT_EQ(ShortText("ab\xC2\xB0"
                      "d",
                      3),
            "ab...");
  EXPECT_EQ(ShortText("ab\xC2\xB0"
                      "d",
                      4),
            "ab\xC2\xB0...");
}

}  // namespace
}  // namespace farhorizon
