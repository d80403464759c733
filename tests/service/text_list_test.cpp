#include "service/text_list.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(CommaList, LeavesOutBlanksAndEmptyEntries) {
  EXPECT_EQ(CommaList(" a ,b,, c d\t, "), (std::vector<std::string>{"a", "b", "c d"}));
  EXPECT_TRUE(CommaList("").empty());
  EXPECT_TRUE(CommaList(" , ").empty());
}

}  // namespace
}  // namespace farhorizon
