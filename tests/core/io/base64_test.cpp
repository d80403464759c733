#include "core/io/base64.h"

#include <vector>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

std::string Encoded(const std::string& text) {
  return ToBase64({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
}

// The examples of RFC 4648, section 10.
TEST(ToBase64, IsThePublishedOne) {
  EXPECT_EQ(Encoded(""), "");
  EXPECT_EQ(Encoded("f"), "Zg==");
  EXPECT_EQ(Encoded("fo"), "Zm8=");
  EXPECT_EQ(Encoded("foo"), "Zm9v");
  EXPECT_EQ(Encoded("foobar"), "Zm9vYmFy");
}

TEST(ToBase64, HasNoSeamWithinLongInput) {
  const std::vector<unsigned char> bytes((std::size_t{3} << 20) * 2 + 1, 0);
  const std::string text = ToBase64(bytes);
  EXPECT_EQ(text.size(), (bytes.size() + 2) / 3 * 4);
  EXPECT_EQ(text.find_first_not_of('A'), text.size() - 2);
  EXPECT_EQ(text.substr(text.size() - 2), "==");
}

}  // namespace
}  // namespace farhorizon
