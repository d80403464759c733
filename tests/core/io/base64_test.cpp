#include "core/io/base64.h"

#include <string>
#include <string_view>
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

// What a text stands for, fed in pieces of this size; "?" where it is no base64.
std::string Decoded(std::string_view text, std::size_t pieces) {
  Base64Decoder decoder;
  std::string bytes;
  for (std::size_t at = 0; at < text.size(); at += pieces) {
    if (!decoder.Feed(text.substr(at, pieces), bytes)) return "?";
  }
  return decoder.MayEnd() ? bytes : "?";
}

TEST(Base64Decoder, UndoesBase64HoweverItIsCut) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  for (std::size_t size : {0U, 1U, 2U, 3U, 255U, 256U}) {
    for (const std::size_t pieces : {1U, 2U, 5U, 1000U}) {
      EXPECT_EQ(Decoded(Encoded(bytes.substr(0, size)), pieces), bytes.substr(0, size)) << size;
    }
  }
  EXPECT_EQ(Decoded("Zm9v\r\nYmFy ", 3), "foobar") << "as mail has it";
  EXPECT_EQ(Decoded("Zm8", 3), "fo") << "without its padding";
}

TEST(Base64Decoder, TakesNothingElse) {
  for (const char* text : {"Z", "Zm9vY", "Zg=", "Zg===", "=", "Z===", "Zg==Zg==", "Zm9v=", "Zm-_",
                           "Zm9v*", "Zg=A", "\xC3\xA9mm9"}) {
    EXPECT_EQ(Decoded(text, 1), "?") << text;
  }
}

}  // namespace
}  // namespace farhorizon
