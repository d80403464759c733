#include "service/outgoing/webhook_secrets.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/base64.h"
#include "core/io/sha256.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;
using testing::Not;

class WebhookSecretsTest : public testing::Test {
 protected:
  void Write(const std::string& text) { std::ofstream(file()) << text; }
  static std::string Line(const std::string& secret) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(secret.data());
    return "whsec_" + ToBase64({bytes, secret.size()}) + "\n";
  }
  [[nodiscard]] std::string file() const { return (folder_ / "secrets").string(); }

  TempDir folder_;
  const std::string old_ = std::string(24, 'o');
  const std::string new_ = std::string(64, 'n');
};

TEST_F(WebhookSecretsTest, SignIdTimeAndBodyWithEach) {
  Write(Line(old_) + "\r\n" + Line(new_));
  const auto secrets = WebhookSecrets::Open(file());
  ASSERT_TRUE(secrets) << secrets.error().message;
  EXPECT_EQ(secrets->Sign("msg", 1614265330, "{}"),
            "v1," + HmacSha256(old_, "msg.1614265330.{}").Base64() + " v1," +
                HmacSha256(new_, "msg.1614265330.{}").Base64());
}

TEST_F(WebhookSecretsTest, AreThoseThatTheFileHasNow) {
  Write(Line(old_));
  const auto secrets = WebhookSecrets::Open(file());
  const std::string before = secrets->Sign("a", 1, "b");
  Write(Line(new_));
  EXPECT_EQ(secrets->Sign("a", 1, "b"), "v1," + HmacSha256(new_, "a.1.b").Base64());
  Write("whsec_broken");
  EXPECT_EQ(secrets->Sign("a", 1, "b"), before) << "those of the start";
}

TEST_F(WebhookSecretsTest, ThatCannotBeUsedAreSaidWithoutTheirText) {
  EXPECT_EQ(WebhookSecrets::Open("").error().kind, "invalid-config");
  EXPECT_EQ(WebhookSecrets::Open(file()).error().kind, "invalid-config");
  for (const std::string& text :
       {std::string(), std::string("\n"), std::string("topsecret\n"), Line(std::string(23, 'a')),
        Line(std::string(65, 'a')), std::string("whsec_***topsecret\n"), Line(old_) + "x\n"}) {
    Write(text);
    const auto secrets = WebhookSecrets::Open(file());
    ASSERT_FALSE(secrets) << text;
    EXPECT_EQ(secrets.error().kind, "invalid-config");
    EXPECT_THAT(secrets.error().message, HasSubstr("callbacks.secretFile"));
    EXPECT_THAT(secrets.error().message, Not(HasSubstr("topsecret")));
  }
}

}  // namespace
}  // namespace farhorizon
