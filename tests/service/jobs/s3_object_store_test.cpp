// The object store in a bucket, on a server of its own, which breaks as it is told. Whoever has
// another server can name it: S3_TEST_URL=s3://BUCKET and the variables that S3Location and
// S3Credentials read; then the conformance suite alone runs, in prefixes of the bucket.
#include "service/jobs/s3_object_store.h"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/hex.h"
#include "core/io/sha256.h"
#include "service/random.h"
#include "service/s3/s3_bucket.h"
#include "tests/service/jobs/object_store_conformance.h"
#include "tests/support/s3_server.h"

namespace farhorizon {
namespace {

using std::chrono::seconds;
using std::chrono::steady_clock;
using testing::HasSubstr;

constexpr std::int64_t kCacheBytes = std::int64_t{1} << 30U;
constexpr std::chrono::milliseconds kPatience{300};

// One for all tests: each has a prefix of its own.
S3Server& Server() {
  static S3Server server;
  return server;
}

std::string NewUrl() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): none is set meanwhile
  const char* given = std::getenv("S3_TEST_URL");
  return std::string(given != nullptr ? given : "s3://tests") + "/" + ToHex(RandomBytes());
}

bool IsOwnServer() { return ::getenv("S3_TEST_URL") == nullptr; }  // NOLINT(concurrency-mt-unsafe)

// The variables stay from the first call on.
S3Location LocationOf(const std::string& url, const S3Options& options = {}) {
  auto location = ReadS3Location(url, options, AwsEnvironment());
  Check(location.has_value(), "the test's URL is one");
  return *location;
}

class S3Storage : public ObjectStorage {
 public:
  explicit S3Storage(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Result<std::unique_ptr<ObjectStore>> Open() override {
    // Of another machine: without copies.
    return OpenS3ObjectStore({LocationOf(url_),
                              {},
                              folder_ / ("cache" + std::to_string(caches_++)),
                              kCacheBytes,
                              0,
                              kPatience});
  }
  void Damage(const std::string& sha256, const std::string& bytes) override {
    S3Credentials credentials({}, AwsEnvironment());
    S3Bucket bucket(LocationOf(url_), credentials);
    ASSERT_TRUE(bucket.PutText("objects/" + sha256, bytes));
  }
  void TakeAway() override { Server().Kill(); }
  void BringBack() override { Server().Start(); }

 private:
  std::string url_ = NewUrl();
  std::filesystem::path folder_;
  int caches_ = 0;
};

std::unique_ptr<ObjectStorage> MakeS3Storage(const std::filesystem::path& folder) {
  return std::make_unique<S3Storage>(folder);
}

INSTANTIATE_TEST_SUITE_P(S3, ObjectStoreConformance, testing::Values(MakeS3Storage));

class S3ObjectStoreTest : public testing::Test {
 protected:
  void SetUp() override { store_ = OpenStore("own"); }
  void TearDown() override { Server().SetFaults("{}"); }
  std::unique_ptr<ObjectStore> OpenStore(const std::string& cache,
                                         std::int64_t bytes = kCacheBytes) {
    auto opened = OpenS3ObjectStore({LocationOf(url_), {}, folder_ / cache, bytes, 0, kPatience});
    EXPECT_TRUE(opened) << opened.error().message;
    return *std::move(opened);
  }
  Result<StoredObject> Put(const std::string& bytes) {
    SpillFile(folder_ / "file", bytes);
    return store_->PutFile(folder_ / "file");
  }
  // How long the call takes.
  template <typename Call>
  static double Seconds(const Call& call) {
    const auto begun = steady_clock::now();
    call();
    return std::chrono::duration<double>(steady_clock::now() - begun).count();
  }

  TempDir folder_;
  std::string url_ = NewUrl();
  std::unique_ptr<ObjectStore> store_;
};

// 2 MB, so that connections break in the middle.
std::string Bytes(unsigned seed) {
  std::mt19937 random(seed);
  std::string bytes(2'000'000, ' ');
  for (std::size_t i = 0; i < bytes.size(); i += 64) bytes[i] = static_cast<char>(random());
  return bytes;
}

TEST_F(S3ObjectStoreTest, WhatIsAnsweredReadsBackWhateverBreaksNowAndThen) {
  unsigned number = 0;
  int answered = 0;
  for (const char* fault :
       {R"("status": 500)", R"("status": 503, "code": "SlowDown")", R"("break": "request")",
        R"("break": "answer")", R"("flip": "request")", R"("flip": "answer")"}) {
    for (int i = 0; i < 3; ++i) {
      const std::string bytes = Bytes(++number);
      Server().SetFaults("{" + std::string(fault) + R"(, "share": 0.4, "only": "/objects/"})");
      const Result<StoredObject> stored = Put(bytes);
      // An error of one is no wonder at four tries, a wrong answer is.
      if (stored) {
        ++answered;
        EXPECT_EQ(stored->sha256, Sha256Hex(bytes));
        const auto other = OpenStore("other" + std::to_string(number));
        const auto copy = folder_ / ("copy" + std::to_string(number));
        const Status copied = other->CopyTo(stored->sha256, copy);
        if (copied) {
          EXPECT_TRUE(SlurpFile(copy) == bytes) << fault;
        } else {
          EXPECT_EQ(copied.error().code, ErrorCode::kIo) << copied.error().message;
        }
        Server().SetFaults("{}");
        std::this_thread::sleep_for(seconds(copied ? 0 : 1));
        const auto later = OpenStore("later" + std::to_string(number));
        ASSERT_TRUE(later->CopyTo(stored->sha256, folder_ / (stored->sha256 + "later")));
        EXPECT_TRUE(SlurpFile(folder_ / (stored->sha256 + "later")) == bytes) << fault;
      } else {
        EXPECT_EQ(stored.error().kind, "storage") << stored.error().message;
      }
    }
  }
  EXPECT_GT(answered, 12) << "of 18";
}

TEST_F(S3ObjectStoreTest, APutThatIsCutOffEachTimeLeavesNoPartOfAnObject) {
  Server().SetFaults(R"({"break": "request", "only": "/objects/"})");
  EXPECT_EQ(Put(Bytes(1)).error().kind, "storage");
  Server().SetFaults("{}");
  std::this_thread::sleep_for(seconds(1));  // so long it is not asked again
  EXPECT_TRUE(store_->List(ObjectList::kAll)->empty());
}

TEST_F(S3ObjectStoreTest, ALargeObjectIsSentInPartsOfWhichNoneStays) {
  std::string bytes;
  for (unsigned i = 0; i < 18; ++i) bytes += Bytes(i);  // 36 MB: three parts
  const Result<StoredObject> stored = Put(bytes);
  ASSERT_TRUE(stored) << stored.error().message;
  EXPECT_TRUE(Server().Files("uploads").empty());
  ASSERT_TRUE(OpenStore("other")->CopyTo(stored->sha256, folder_ / "copy"));
  EXPECT_TRUE(SlurpFile(folder_ / "copy") == bytes);

  bytes[0] = '!';
  Server().SetFaults(R"({"break": "request", "only": "partNumber=2"})");
  EXPECT_EQ(Put(bytes).error().kind, "storage");
  EXPECT_TRUE(Server().Files("uploads").empty()) << "given up";
  Server().SetFaults("{}");
  std::this_thread::sleep_for(seconds(1));
  EXPECT_EQ(store_->List(ObjectList::kAll)->size(), 1U);
}

TEST_F(S3ObjectStoreTest, AKillInTheMiddleOfAnUploadLeavesNoObjectAndPartsToGiveUp) {
  std::string bytes;
  for (unsigned i = 0; i < 18; ++i) bytes += Bytes(i + 100);
  SpillFile(folder_ / "file", bytes);
  Server().SetFaults(R"({"stall": 30, "only": "partNumber=2"})");
  const pid_t child = ::fork();
  if (child == 0) {
    (void)OpenStore("child")->PutFile(folder_ / "file");
    ::_exit(0);
  }
  for (int tries = 0; tries < 500 && Server().Files("uploads").empty(); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(store_->List(ObjectList::kAll)->empty());
  EXPECT_EQ(*store_->List(ObjectList::kIncoming), std::vector<std::string>{Sha256Hex(bytes)});
  const std::vector<std::string> uploads = Server().Files("uploads");
  ASSERT_EQ(uploads.size(), 1U);
  Server().SetFaults("{}");
  // As the rule of the bucket does.
  S3Credentials credentials({}, AwsEnvironment());
  S3Client client(LocationOf(url_), credentials);
  const std::string id = uploads[0].substr(uploads[0].find('=') + 1);
  const std::string key = LocationOf(url_).prefix + "objects/" + Sha256Hex(bytes);
  EXPECT_EQ(client.Send({.method = "DELETE", .key = key, .query = "uploadId=" + id})->status, 204);
  EXPECT_TRUE(Server().Files("uploads").empty());
}

TEST_F(S3ObjectStoreTest, AStorageThatStandsStillCostsSecondsAndThenNone) {
  const Result<StoredObject> stored = Put("hello");
  ASSERT_TRUE(stored);
  store_->Distrust(stored->sha256);
  Server().Signal(SIGSTOP);
  EXPECT_LT(Seconds([&] { EXPECT_EQ(store_->CheckWrites().error().kind, "storage"); }), 5);
  EXPECT_LT(Seconds([&] { EXPECT_EQ(store_->Open(stored->sha256).error().kind, "storage"); }), 0.5);
  Server().Signal(SIGCONT);
  std::this_thread::sleep_for(seconds(1));
  EXPECT_TRUE(store_->Open(stored->sha256));
}

TEST_F(S3ObjectStoreTest, SaysWhatIsWrongAndNoSecret) {
  const auto message = [&](const std::string& url, const S3Options& options) {
    S3Options with = options;
    auto opened = OpenS3ObjectStore(
        {LocationOf(url, with), options.credentials, folder_ / "cache", kCacheBytes, 0});
    return opened ? "" : opened.error().message;
  };
  EXPECT_THAT(message("s3://no-such-bucket", {}), HasSubstr("no such bucket; make it"));
  SpillFile(folder_ / "keys",
            "[default]\naws_access_key_id = other\naws_secret_access_key = hush\n");
  const std::string refused = message(url_, {"", "", S3Addressing::kAuto, folder_ / "keys"});
  EXPECT_THAT(refused, HasSubstr("refuses these keys (InvalidAccessKeyId)"));
  EXPECT_THAT(refused, testing::Not(HasSubstr("hush")));
  SpillFile(folder_ / "keys",
            "[default]\naws_access_key_id = test-key-id\naws_secret_access_key = hush\n");
  EXPECT_THAT(message(url_, {"", "", S3Addressing::kAuto, folder_ / "keys"}),
              HasSubstr("SignatureDoesNotMatch"));
  EXPECT_THAT(message(url_, {"http://127.0.0.1:9", "", S3Addressing::kAuto, ""}),
              HasSubstr("out of reach"));
  Server().SetFaults(R"({"status": 404, "code": "x"})");  // another server's page
  EXPECT_EQ(store_->Open(std::string(64, 'a')).error().kind, "storage");
}

TEST_F(S3ObjectStoreTest, TakesKeysThatWereReplacedInTheirFile) {
  const auto write = [&](const std::string& secret) {
    SpillFile(folder_ / "keys",
              "[default]\naws_access_key_id = test-key-id\n"
              "aws_secret_access_key = " +
                  secret + "\n");
  };
  write("test/secret+of-the-store");
  auto opened =
      OpenS3ObjectStore({LocationOf(url_), folder_ / "keys", folder_ / "c", kCacheBytes, 0});
  ASSERT_TRUE(opened) << opened.error().message;
  write("another");
  EXPECT_FALSE((*opened)->SetLabel("x"));
  write("test/secret+of-the-store");
  EXPECT_TRUE((*opened)->SetLabel("x"));
}

TEST_F(S3ObjectStoreTest, ReadsOfOneObjectAtOnceFetchItOnce) {
  const Result<StoredObject> stored = Put(Bytes(7));
  ASSERT_TRUE(stored);
  const auto other = OpenStore("other");
  const int before = Server().Count("GET");
  Server().SetFaults(R"({"stall": 0.2, "only": "/objects/"})");
  std::array<std::thread, 8> threads;
  for (std::thread& thread : threads) {
    thread = std::thread([&] { EXPECT_EQ(other->Open(stored->sha256)->bytes, stored->bytes); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(Server().Count("GET"), before + 1);
  EXPECT_TRUE(store_->Open(stored->sha256)) << "whoever put it has a copy";
  EXPECT_EQ(Server().Count("GET"), before + 1);
}

TEST_F(S3ObjectStoreTest, ListsMoreThanAPage) {
  S3Credentials credentials({}, AwsEnvironment());
  S3Bucket bucket(LocationOf(url_), credentials);
  std::vector<std::string> keys;
  for (int i = 0; i < 1030; ++i) {
    keys.push_back("objects/" + Sha256Hex(std::to_string(i)));
    SpillFile(Server().FileOf(LocationOf(url_).prefix + keys.back()), "");
  }
  EXPECT_EQ(store_->List(ObjectList::kAll)->size(), keys.size());
  EXPECT_TRUE(bucket.DeleteAll(keys));
  EXPECT_TRUE(store_->List(ObjectList::kAll)->empty());
}

}  // namespace
}  // namespace farhorizon

int main(int count, char** words) {
  using namespace farhorizon;
  testing::InitGoogleTest(&count, words);
  constexpr int kSkipped = 77;
  if (!IsOwnServer()) {
    testing::GTEST_FLAG(filter) = "S3/*-*OutOfReach*";
    return RUN_ALL_TESTS();
  }
  if (!S3Server::IsInstalled()) {
    std::puts("skipped: no python3");
    return kSkipped;
  }
  for (const std::string& variable : Server().Environment()) {
    const std::size_t equals = variable.find('=');
    ::setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
  }
  return RUN_ALL_TESTS();
}
