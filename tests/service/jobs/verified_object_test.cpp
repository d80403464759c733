#include "service/jobs/verified_object.h"

#include <fcntl.h>
#include <string>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "service/jobs/local_object_store.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

class VerifiedObjectTest : public testing::Test {
 protected:
  void SetUp() override {
    auto opened = OpenLocalObjectStore(folder_ / "objects");
    ASSERT_TRUE(opened);
    store_ = *std::move(opened);
    for (int i = 0; i < 150'000; ++i) content_ += static_cast<char>(i * 7 + i / 251);
    SpillFile(folder_ / "file", content_);
    name_ = store_->PutFile(folder_ / "file")->sha256;
    path_ = folder_ / "objects" / name_.substr(0, 2) / name_;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all);
  }
  Result<std::shared_ptr<VerifiedObject>> Open() {
    return verifier_.Open(*store_->Open(name_), name_);
  }
  static std::string ReadAll(VerifiedObject& object, std::int64_t from, std::int64_t bytes) {
    std::string all;
    while (static_cast<std::int64_t>(all.size()) < bytes) {
      const auto at = static_cast<std::int64_t>(all.size());
      const auto piece = object.Read(from + at, bytes - at);
      if (!piece) return all + "<" + std::string(piece.error().kind) + ">";
      all += *piece;
    }
    return all;
  }
  /// Turns a bit; the file looks as it did before where `secretly`.
  void Flip(std::size_t at, bool secretly) {
    struct stat before {};
    ASSERT_EQ(::stat(path_.c_str(), &before), 0);
    std::string damaged = content_;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    SpillFile(path_, damaged);
    const struct timespec times[2] = {before.st_atim, before.st_mtim};
    const struct timespec later[2] = {{1, 0}, {1, 0}};
    ASSERT_EQ(::utimensat(AT_FDCWD, path_.c_str(), secretly ? times : later, 0), 0);
  }

  TempDir folder_;
  std::unique_ptr<ObjectStore> store_;
  ObjectVerifier verifier_;
  std::string content_;
  std::string name_;
  std::filesystem::path path_;
};

TEST_F(VerifiedObjectTest, GivesEveryRangeAsItIs) {
  const auto object = Open();
  ASSERT_TRUE(object);
  const auto size = static_cast<std::int64_t>(content_.size());
  EXPECT_EQ((*object)->bytes(), size);
  for (const auto& [from, bytes] :
       std::vector<std::pair<std::int64_t, std::int64_t>>{{0, size},
                                                          {0, 1},
                                                          {65535, 2},
                                                          {65536, 65536},
                                                          {131072, 7},
                                                          {size - 1, 1},
                                                          {10, 140'000}}) {
    EXPECT_EQ(ReadAll(**object, from, bytes),
              content_.substr(static_cast<std::size_t>(from), static_cast<std::size_t>(bytes)))
        << from << ", " << bytes;
  }
}

TEST_F(VerifiedObjectTest, DoesNotOpenWhatIsDamaged) {
  Flip(149'999, false);
  EXPECT_EQ(Open().error().kind, "result-corrupt");
}

TEST_F(VerifiedObjectTest, LooksAgainWhereTheFileWasWrittenTo) {
  ASSERT_TRUE(Open());
  Flip(70'000, false);
  EXPECT_EQ(Open().error().kind, "result-corrupt");
  SpillFile(path_, content_);
  EXPECT_TRUE(Open());
}

TEST_F(VerifiedObjectTest, GivesNoByteOfAPieceThatWentBadUnnoticed) {
  const auto object = Open();
  ASSERT_TRUE(object);
  Flip(70'000, true);
  const auto reopened = Open();
  ASSERT_TRUE(reopened) << "nothing shows yet";
  EXPECT_EQ(ReadAll(**reopened, 0, 100'000), content_.substr(0, 65536) + "<result-corrupt>");
  EXPECT_EQ(ReadAll(**reopened, 140'000, 5), content_.substr(140'000, 5));
  EXPECT_EQ(Open().error().kind, "result-corrupt") << "and it is remembered";
}

TEST_F(VerifiedObjectTest, SeesAFileThatIsCut) {
  std::filesystem::resize_file(path_, 100);
  EXPECT_EQ(Open().error().kind, "result-corrupt");
}

}  // namespace
}  // namespace farhorizon
