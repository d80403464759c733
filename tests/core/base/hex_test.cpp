#include "core/base/hex.h"

#include <array>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(ToHex, HasTwoDigitsForEachByte) {
  const std::array<unsigned char, 4> bytes = {0x00, 0x0F, 0xA0, 0xFF};
  EXPECT_EQ(ToHex(bytes), "000fa0ff");
  EXPECT_EQ(ToHex({}), "");
}

TEST(IsLowerHexDigit, IsTrueForSixteenCharacters) {
  int count = 0;
  for (int c = 0; c < 256; ++c) count += IsLowerHexDigit(static_cast<char>(c)) ? 1 : 0;
  EXPECT_EQ(count, 16);
  for (const char c : std::string("0123456789abcdef")) EXPECT_TRUE(IsLowerHexDigit(c)) << c;
}

}  // namespace
}  // namespace farhorizon
