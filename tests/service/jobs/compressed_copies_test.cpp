#include "service/jobs/compressed_copies.h"

#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "service/jobs/local_object_store.h"
#include "tests/support/gunzip.h"
#include "tests/support/temp_dir.h"
#include "tests/support/unzstd.h"

namespace farhorizon {
namespace {

namespace fs = std::filesystem;

std::string Noise(std::size_t bytes) {
  std::mt19937 random(7);
  std::string noise;
  while (noise.size() < bytes) noise += static_cast<char>(random() & 0xFFU);
  return noise;
}

std::string Numbers(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += std::to_string(i * 7919) + ", ";
  return text;
}

class CompressedCopiesTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(folder_ / "spool");
    store_ = *OpenLocalObjectStore(folder_ / "objects");
  }
  /// The artifact of these bytes, with its copy where it has one.
  Artifact Copied(const std::string& bytes) {
    SpillFile(folder_ / "file", bytes);
    const StoredObject stored = *store_->PutFile(folder_ / "file");
    std::vector<Artifact> artifacts = {{"a", "x/y", stored.bytes, stored.sha256}};
    const Status done = AddCompressedCopies(artifacts, *store_, folder_ / "spool");
    EXPECT_TRUE(done) << done.error().message;
    EXPECT_TRUE(fs::is_empty(folder_ / "spool"));
    return artifacts.at(0);
  }
  std::string Stored(const StoredObject& object) {
    EXPECT_TRUE(store_->CopyTo(object.sha256, folder_ / "copy"));
    std::string bytes = SlurpFile(folder_ / "copy");
    EXPECT_EQ(static_cast<std::int64_t>(bytes.size()), object.bytes);
    fs::remove(folder_ / "copy");
    return bytes;
  }

  TempDir folder_;
  std::unique_ptr<ObjectStore> store_;
};

TEST_F(CompressedCopiesTest, HoldTheSameBytesInFewer) {
  // One piece, and several: the first one's look must not show in the bytes.
  for (const int count : {1000, 200'000}) {
    const std::string text = Numbers(count);
    const Artifact artifact = Copied(text);
    ASSERT_TRUE(artifact.gzip) << count;
    EXPECT_LT(artifact.gzip->bytes, artifact.bytes / 2);
    EXPECT_EQ(Gunzip(Stored(*artifact.gzip)), text);
    EXPECT_EQ(Copied(text).gzip->sha256, artifact.gzip->sha256) << "same bytes, same copy";
  }
}

TEST_F(CompressedCopiesTest, AreInZstdWhereThatSavesATenthOfGzip) {
  // One piece, and several: the first one's look must not show in the bytes.
  for (const int count : {20'000, 200'000}) {
    const std::string text = Numbers(count);
    const Artifact artifact = Copied(text);
    ASSERT_TRUE(artifact.gzip && artifact.zstd) << count;
    EXPECT_LE(artifact.zstd->bytes, artifact.gzip->bytes - artifact.gzip->bytes / 10);
    EXPECT_EQ(Unzstd(Stored(*artifact.zstd)), text);
    EXPECT_EQ(Copied(text).zstd->sha256, artifact.zstd->sha256) << "same bytes, same copy";
  }
  const Artifact artifact = Copied(Numbers(1000));
  EXPECT_TRUE(artifact.gzip);
  EXPECT_FALSE(artifact.zstd) << "less than a block";
}

// Some 8 s of zstd a job are enough.
TEST_F(CompressedCopiesTest, AreNotInZstdWhereThereIsTooMuch) {
  const Artifact artifact = Copied(std::string(std::size_t{33} << 20U, 'a'));
  EXPECT_TRUE(artifact.gzip);
  EXPECT_FALSE(artifact.zstd);
}

TEST_F(CompressedCopiesTest, AreNotMadeWhereTheySaveLittle) {
  EXPECT_FALSE(Copied("").gzip);
  EXPECT_FALSE(Copied(std::string(4100, ' ')).gzip) << "less than a block";
  EXPECT_FALSE(Copied(Noise(100'000)).gzip);
  EXPECT_FALSE(Copied(Noise(1'000'000)).gzip);
  EXPECT_FALSE(Copied(Numbers(2000) + Noise(500'000)).gzip) << "a twentieth of it is text";
  EXPECT_EQ(store_->List(ObjectList::kAll)->size(), 5U) << "nothing but the artifacts";
}

TEST_F(CompressedCopiesTest, TellOfAnObjectThatIsGone) {
  std::vector<Artifact> artifacts = {{"a", "x/y", 10'000, std::string(64, 'a')}};
  EXPECT_EQ(AddCompressedCopies(artifacts, *store_, folder_ / "spool").error().code,
            ErrorCode::kNotFound);
}

}  // namespace
}  // namespace farhorizon
