#include "core/io/sha256.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// FIPS 180-4's example "abc".
constexpr const char* kAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

Digest DigestOf(std::initializer_list<std::string_view> pieces) {
  Sha256 sum;
  for (const std::string_view piece : pieces) sum.Add(piece);
  return sum.Finish();
}

TEST(Sha256, IsThePublishedOneHoweverThePiecesAreCut) {
  EXPECT_EQ(DigestOf({"abc"}).Hex(), kAbc);
  EXPECT_EQ(DigestOf({"a", "", "bc"}), DigestOf({"abc"}));
}

TEST(Digest, IsWrittenInBase64) {
  EXPECT_EQ(DigestOf({}).Base64(), "47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=");
}

TEST(Digest, IsReadFromItsHex) {
  EXPECT_EQ(Digest::FromHex(kAbc), DigestOf({"abc"}));
  std::string upper = kAbc;
  upper[0] = 'B';
  for (const std::string& text : {std::string(), upper, std::string(kAbc) + "0",
                                  std::string(kAbc).substr(1), std::string(64, 'g')}) {
    EXPECT_FALSE(Digest::FromHex(text)) << text;
  }
}

TEST(Digest, IsComparedInConstantTimeToo) {
  EXPECT_TRUE(SameDigest(DigestOf({"abc"}), DigestOf({"abc"})));
  EXPECT_FALSE(SameDigest(DigestOf({"abc"}), DigestOf({"abd"})));
}

// RFC 4231, section 4.3.
TEST(HmacSha256, IsThePublishedOne) {
  EXPECT_EQ(HmacSha256("Jefe", "what do ya want for nothing?").Hex(),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
}

}  // namespace
}  // namespace farhorizon
