#include "service/handlers/result_wishes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(ResultWishes, AreReadAsTheyWereWritten) {
  EXPECT_EQ(WriteResultWishes({}), "") << "jobs without an execute request have none";
  const ResultWishes wishes{true, {{{"a", Transmission::kValue}, {"b", Transmission::kReference}}}};
  const ResultWishes read = ReadResultWishes(WriteResultWishes(wishes));
  EXPECT_TRUE(read.raw);
  EXPECT_EQ(read.outputs, wishes.outputs);
  EXPECT_TRUE(ReadResultWishes(WriteResultWishes({true, {}})).raw);
  for (const char* text : {"", "x", "[]", "{}"}) {
    EXPECT_FALSE(ReadResultWishes(text).raw) << text;
    EXPECT_FALSE(ReadResultWishes(text).outputs) << text;
  }
}

}  // namespace
}  // namespace farhorizon
