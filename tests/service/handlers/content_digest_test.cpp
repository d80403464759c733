#include "service/handlers/content_digest.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// Of "hello", as `printf hello | openssl dgst -sha256 -binary | base64` says.
constexpr const char* kHello = "LPJNul+wow4m6DsqxbninhsWHlwfp0JecwQzYpOLmCQ=";

bool Holds(const std::string& field, const std::string& body) {
  HttpRequest request;
  request.headers.emplace_back("content-digest", field);
  Result<ContentDigest> digest = ContentDigest::Of(request);
  if (!digest) return false;
  for (const char c : body) digest->Add(std::string_view(&c, 1));
  return static_cast<bool>(digest->Check());
}

TEST(ContentDigest, HoldsTheBodyToItsSha256) {
  const std::string field = "sha-256=:" + std::string(kHello) + ":";
  EXPECT_TRUE(Holds(field, "hello"));
  EXPECT_FALSE(Holds(field, "hallo"));
  EXPECT_FALSE(Holds(field, ""));
  EXPECT_TRUE(Holds("sha-512=:AAAA:, " + field, "hello"));
}

TEST(ContentDigest, PassesOverOtherAlgorithms) { EXPECT_TRUE(Holds("md5=:AAAA:", "hello")); }

TEST(ContentDigest, RefusesWhatItCannotRead) {
  for (const char* field : {"sha-256", "sha-256=abc", "sha-256=:abc:", "sha-256=:", "=", ",,"}) {
    EXPECT_FALSE(Holds(field, "hello")) << field;
  }
}

TEST(ContentDigest, NeedsNone) {
  Result<ContentDigest> digest = ContentDigest::Of({});
  ASSERT_TRUE(digest);
  digest->Add("anything");
  EXPECT_TRUE(digest->Check());
}

}  // namespace
}  // namespace farhorizon
