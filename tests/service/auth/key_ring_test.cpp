#include "service/auth/key_ring.h"

#include <gtest/gtest.h>

#include "service/auth/key_file.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

class KeyRingTest : public testing::Test {
 protected:
  void SetUp() override { ring_ = *KeyRing::Open(file_); }
  NewKey Add(std::optional<std::int64_t> expires_ms = {}) {
    NewKey made = MakeKey("a", {Scope::kRead}, 5);
    made.key.expires_ms = expires_ms;
    EXPECT_TRUE(ChangeKeys(file_, [&](std::vector<ApiKey>& keys) -> Status {
      keys.push_back(made.key);
      return Ok{};
    }));
    return made;
  }
  std::string WhyNot(const std::string& text, std::int64_t now_ms = 10) {
    const Result<ApiKey> key = ring_->Match(text, now_ms);
    if (key) return "";
    EXPECT_EQ(key.error().kind, "invalid-key");
    return key.error().message;
  }
  TempDir folder_;
  const std::filesystem::path file_ = folder_ / "keys.json";
  std::shared_ptr<KeyRing> ring_;
};

TEST_F(KeyRingTest, KnowsAKeyAtOnceAndNoLongerWhenItIsRevoked) {
  EXPECT_FALSE(ring_->HadFile());
  const NewKey made = Add();
  EXPECT_TRUE(ring_->HadFile());
  EXPECT_EQ(ring_->CountLive(10), 1);
  EXPECT_EQ(ring_->Match(made.text, 10)->id, made.key.id);
  EXPECT_EQ(ring_->Find(made.key.id, 10)->id, made.key.id);
  ASSERT_TRUE(ChangeKeys(file_, [](std::vector<ApiKey>& keys) -> Status {
    keys.at(0).revoked_ms = 8;
    return Ok{};
  }));
  EXPECT_NE(WhyNot(made.text).find("revoked"), std::string::npos);
  EXPECT_FALSE(ring_->Find(made.key.id, 10));
  EXPECT_EQ(ring_->CountLive(10), 0);
}

TEST_F(KeyRingTest, TellsAStrangerNothing) {
  const NewKey made = Add(7);
  std::string other = made.text;
  other.back() = other.back() == '0' ? '1' : '0';
  const std::string none = WhyNot("fh_000000000000_" + std::string(64, '0'));
  EXPECT_EQ(WhyNot(other), none) << "that there is such an id, or that it has expired";
  EXPECT_EQ(WhyNot("x"), none);
  EXPECT_NE(WhyNot(made.text).find("expired"), std::string::npos) << "who has it may know";
  EXPECT_EQ(WhyNot(made.text, 6), "");
}

TEST_F(KeyRingTest, StaysAsItWasWhereTheFileCannotBeReadAndFailsClosedWhereItIsGone) {
  const NewKey made = Add();
  EXPECT_EQ(WhyNot(made.text), "");
  const std::string sound = SlurpFile(file_);
  SpillFile(file_, "{");
  EXPECT_EQ(WhyNot(made.text), "");
  SpillFile(file_, sound);
  EXPECT_EQ(WhyNot(made.text), "");
  std::filesystem::remove(file_);
  EXPECT_NE(WhyNot(made.text), "");
  EXPECT_TRUE(ring_->HadFile()) << "who had keys once goes on asking for them";
}

TEST_F(KeyRingTest, OpensNoDamagedFile) {
  SpillFile(file_, "{");
  EXPECT_FALSE(KeyRing::Open(file_));
}

}  // namespace
}  // namespace farhorizon
