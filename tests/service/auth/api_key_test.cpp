#include "service/auth/api_key.h"

#include <string>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(ApiKey, HasATextOfItsOwnAndKeepsTheHashAlone) {
  const NewKey made = MakeKey("ada", {Scope::kRead}, 5);
  const NewKey other = MakeKey("ada", {Scope::kRead}, 5);
  EXPECT_EQ(made.text.size(), 80U);
  EXPECT_EQ(made.text.substr(0, 3) + made.key.id + "_", made.text.substr(0, 16));
  EXPECT_EQ(IdOfKey(made.text), made.key.id);
  EXPECT_EQ(made.key.digest.Hex(), Sha256Hex(made.text));
  EXPECT_EQ(made.key.owner, made.key.id);
  EXPECT_NE(made.key.id, other.key.id);
  EXPECT_NE(made.text.substr(16), other.text.substr(16));
}

TEST(ApiKey, IsNoOtherText) {
  const std::string text = MakeKey("a", {Scope::kRead}, 5).text;
  for (const std::string& wrong :
       {std::string(), std::string("fh_"), text + "0", text.substr(1), " " + text.substr(1),
        "FH_" + text.substr(3), text.substr(0, 79) + "g",
        text.substr(0, 15) + "-" + text.substr(16), "fh_" + std::string(77, '_'),
        std::string(100'000, 'f')}) {
    EXPECT_FALSE(IdOfKey(wrong)) << wrong.substr(0, 100);
  }
}

TEST(ApiKey, LivesUntilItExpiresOrIsRevoked) {
  ApiKey key = MakeKey("a", {Scope::kRead}, 5).key;
  EXPECT_TRUE(key.IsLive(1'000'000'000'000));
  key.expires_ms = 10;
  EXPECT_TRUE(key.IsLive(9));
  EXPECT_FALSE(key.IsLive(10));
  key.revoked_ms = 7;
  EXPECT_FALSE(key.IsLive(9));
}

TEST(ApiKey, HasANameThatATerminalCanShow) {
  EXPECT_TRUE(CheckKeyName("Ada's pipeline, Zürich"));
  for (const std::string& name : {std::string(), std::string(101, 'a'), std::string("a\x1b[31m"),
                                  std::string("a\nb"), std::string("a\x7f")}) {
    EXPECT_FALSE(CheckKeyName(name)) << name;
  }
}

TEST(Scopes, AreReadAndNamed) {
  const Result<Scopes> some = ReadScopes("read, submit");
  ASSERT_TRUE(some);
  EXPECT_TRUE(some->Has(Scope::kSubmit));
  EXPECT_FALSE(some->Has(Scope::kDelete));
  EXPECT_FALSE(some->Has(Scope::kAdmin));
  EXPECT_EQ(NamesOf(*some), (std::vector<std::string>{"submit", "read"}));
  EXPECT_FALSE(ReadScopes(""));
  EXPECT_FALSE(ReadScopes("read,root"));
}

TEST(Scopes, OfAnAdminAreAll) {
  const Scopes admin = {Scope::kAdmin};
  for (const Scope scope : {Scope::kSubmit, Scope::kRead, Scope::kDelete, Scope::kAdmin}) {
    EXPECT_TRUE(admin.Has(scope));
  }
  EXPECT_EQ(NamesOf(admin), std::vector<std::string>{"admin"});
}

}  // namespace
}  // namespace farhorizon
