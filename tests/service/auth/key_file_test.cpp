#include "service/auth/key_file.h"

#include <sys/stat.h>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

class KeyFile : public testing::Test {
 protected:
  NewKey Add(const std::string& name) {
    NewKey made = MakeKey(name, {Scope::kSubmit, Scope::kRead}, 5);
    const Status added = ChangeKeys(file_, [&](std::vector<ApiKey>& keys) -> Status {
      keys.push_back(made.key);
      return Ok{};
    });
    EXPECT_TRUE(added);
    return made;
  }
  TempDir folder_;
  const std::filesystem::path file_ = folder_ / "data" / "keys.json";
};

TEST_F(KeyFile, KeepsAllButTheText) {
  EXPECT_EQ(ReadKeys(file_).error().code, ErrorCode::kNotFound);
  const NewKey made = Add("ada \"\\");
  const Status revoked = ChangeKeys(file_, [](std::vector<ApiKey>& keys) -> Status {
    keys.at(0).expires_ms = 8;
    keys.at(0).revoked_ms = 9;
    return Ok{};
  });
  ASSERT_TRUE(revoked);
  const Result<std::vector<ApiKey>> read = ReadKeys(file_);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 1U);
  const ApiKey& key = read->at(0);
  EXPECT_EQ(key.id, made.key.id);
  EXPECT_EQ(key.owner, made.key.owner);
  EXPECT_EQ(key.name, "ada \"\\");
  EXPECT_EQ(key.scopes, made.key.scopes);
  EXPECT_EQ(key.digest, made.key.digest);
  EXPECT_EQ(key.created_ms, 5);
  EXPECT_EQ(key.expires_ms, 8);
  EXPECT_EQ(key.revoked_ms, 9);
  EXPECT_THAT(SlurpFile(file_), testing::Not(testing::HasSubstr(made.text.substr(16))));
}

TEST_F(KeyFile, IsForItsOwnersEyesAlone) {
  Add("a");
  for (const auto& [path, mode] :
       {std::pair(file_, 0600U), std::pair(file_.parent_path(), 0700U)}) {
    struct stat info {};
    ASSERT_EQ(::stat(path.c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777U, mode) << path;
  }
}

TEST_F(KeyFile, StaysWhereAChangeFails) {
  Add("a");
  const std::string before = SlurpFile(file_);
  EXPECT_FALSE(ChangeKeys(file_, [](std::vector<ApiKey>& keys) -> Status {
    keys.clear();
    return Error{ErrorCode::kNotFound, "no"};
  }));
  EXPECT_EQ(SlurpFile(file_), before);
}

TEST_F(KeyFile, LosesNoneOfTwoThatChangeItAtOnce) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int j = 0; j < 5; ++j) Add("a");
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(ReadKeys(file_)->size(), 20U);
}

TEST_F(KeyFile, RefusesWhatItDoesNotUnderstandAndNeverLosesIt) {
  Add("a");
  const std::string sound = SlurpFile(file_);
  const auto damaged = [&](const std::string& from, const std::string& to) {
    std::string text = sound;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[]"), sound.substr(0, sound.size() / 2),
        damaged("\"version\": 1", "\"version\": 2"), damaged("\"sha256\"", "\"sha255\""),
        damaged("submit,read", "submit,root"), damaged("\"created_ms\": 5", "\"created_ms\": \"\""),
        damaged("\"created_ms\": 5", "\"created_ms\": 5, \"revoked_ms\": \"now\""),
        damaged("\"name\": \"a\"", "\"name\": \"\\u001b\"")}) {
    SpillFile(file_, text);
    const Result<std::vector<ApiKey>> read = ReadKeys(file_);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().kind, "data-directory") << read.error().message;
    EXPECT_FALSE(ChangeKeys(file_, [](std::vector<ApiKey>&) -> Status { return Ok{}; })) << text;
    EXPECT_EQ(SlurpFile(file_), text);
  }
}

}  // namespace
}  // namespace farhorizon
