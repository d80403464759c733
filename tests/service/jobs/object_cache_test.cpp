#include "service/jobs/object_cache.h"

#include <chrono>

#include <gtest/gtest.h>

#include "core/io/posix_file.h"
#include "core/io/sha256.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

class ObjectCacheTest : public testing::Test {
 protected:
  std::unique_ptr<ObjectCache> Make(std::int64_t most_bytes, std::int64_t least_free = 0) {
    auto cache = ObjectCache::Make(folder_ / "cache", most_bytes, least_free, patience_);
    EXPECT_TRUE(cache);
    return *std::move(cache);
  }
  // The bytes of the object, by one fetch or none.
  std::string Get(ObjectCache& cache, const std::string& bytes) {
    const auto fetch = [&](int fd) -> Status {
      ++fetches_;
      EXPECT_TRUE(WriteAll(fd, bytes));
      return Ok{};
    };
    const Result<OpenObject> object = cache.Get(Sha256Hex(bytes), fetch);
    EXPECT_TRUE(object) << object.error().message;
    std::string read(100, ' ');
    read.resize(static_cast<std::size_t>(ReadSome(object->fd.get(), read)));
    return read;
  }
  [[nodiscard]] std::size_t Files() const {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "cache")) {
      files += entry.is_regular_file() ? 1 : 0;
    }
    return files;
  }

  TempDir folder_;
  std::chrono::milliseconds patience_{300};
  int fetches_ = 0;
};

TEST_F(ObjectCacheTest, FetchesOnceAndLetsTheLeastRecentlyUsedGo) {
  const auto cache = Make(8);
  EXPECT_EQ(Get(*cache, "aaaa"), "aaaa");
  EXPECT_EQ(Get(*cache, "bbbb"), "bbbb");
  EXPECT_EQ(Get(*cache, "aaaa"), "aaaa");
  EXPECT_EQ(fetches_, 2);
  EXPECT_EQ(Get(*cache, "cccc"), "cccc");  // bbbb leaves
  EXPECT_EQ(Get(*cache, "aaaa"), "aaaa");
  EXPECT_EQ(fetches_, 3);
  EXPECT_EQ(Get(*cache, "bbbb"), "bbbb");
  EXPECT_EQ(fetches_, 4);
  EXPECT_EQ(Files(), 2U);
}

TEST_F(ObjectCacheTest, KeepsOneWhereThereIsNoRoomAtAll) {
  const auto cache = Make(0);
  EXPECT_EQ(Get(*cache, "aaaa"), "aaaa");
  EXPECT_EQ(Get(*cache, "bbbb"), "bbbb");
  EXPECT_EQ(Files(), 1U);
  const auto short_of_disk = Make(1 << 20, std::int64_t{1} << 60U);
  EXPECT_EQ(Get(*short_of_disk, "aaaa"), "aaaa");
  EXPECT_EQ(Get(*short_of_disk, "cccc"), "cccc");
  EXPECT_EQ(Files(), 1U);
}

TEST_F(ObjectCacheTest, AReaderReadsOnWhenTheFileLeaves) {
  const auto cache = Make(4);
  const auto object = cache->Get(Sha256Hex("aaaa"), [](int fd) -> Status {
    EXPECT_TRUE(WriteAll(fd, "aaaa"));
    return Ok{};
  });
  Get(*cache, "bbbb");
  EXPECT_EQ(Files(), 1U);
  std::string read(9, ' ');
  EXPECT_EQ(ReadSome(object->fd.get(), read), 4);
}

TEST_F(ObjectCacheTest, TrustsNothingThatAnEarlierProcessHasLeftUnseen) {
  Get(*Make(100), "aaaa");
  Get(*Make(100), "bbbb");
  EXPECT_EQ(fetches_, 2);
  SpillFile(folder_ / "cache" / "temp" / "half", "x");
  const std::string name = Sha256Hex("aaaa");
  std::filesystem::permissions(folder_ / "cache" / name, std::filesystem::perms::owner_all);
  SpillFile(folder_ / "cache" / name, "aaax");
  const auto cache = Make(100);
  EXPECT_EQ(Get(*cache, "aaaa"), "aaaa");
  EXPECT_EQ(fetches_, 3) << "it was damaged";
  EXPECT_EQ(Get(*cache, "bbbb"), "bbbb");
  EXPECT_EQ(fetches_, 3) << "it was sound";
  EXPECT_EQ(Files(), 2U);
}

TEST_F(ObjectCacheTest, GivesOutNoWrongBytes) {
  const auto cache = Make(100);
  int fetches = 0;
  const auto object = cache->Get(Sha256Hex("aaaa"), [&](int fd) -> Status {
    EXPECT_TRUE(WriteAll(fd, ++fetches < 3 ? "aaab" : "aaaa"));
    return Ok{};
  });
  EXPECT_TRUE(object) << "the third time";
  const auto wrong = cache->Get(Sha256Hex("bbbb"), [](int fd) -> Status {
    EXPECT_TRUE(WriteAll(fd, "bbb"));
    return Ok{};
  });
  EXPECT_EQ(wrong.error().kind, "input-corrupt");
  EXPECT_EQ(Files(), 1U);
}

// All that a server or the way to it sends may be wrong for seconds, and the object be sound.
TEST_F(ObjectCacheTest, TakesOtherBytesForAFaultThatPassesAsLongAsItsPatienceLasts) {
  patience_ = std::chrono::seconds(60);
  const auto cache = Make(100);
  int fetches = 0;
  const auto object = cache->Get(Sha256Hex("aaaa"), [&](int fd) -> Status {
    EXPECT_TRUE(WriteAll(fd, ++fetches < 5 ? "aaab" : "aaaa"));
    return Ok{};
  });
  EXPECT_TRUE(object);
  EXPECT_EQ(fetches, 5);
}

}  // namespace
}  // namespace farhorizon
