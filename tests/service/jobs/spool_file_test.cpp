#include "service/jobs/spool_file.h"

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

TEST(SpoolFile, KeepsBytesNumberAndBeginning) {
  const TempDir folder;
  auto file = SpoolFile::Create(folder.path());
  ASSERT_TRUE(file);
  const std::string first(4000, 'a');
  const std::string second(4000, 'b');
  ASSERT_TRUE(file->Write(first));
  ASSERT_TRUE(file->Write(second));
  EXPECT_EQ(file->bytes(), 8000);
  EXPECT_EQ(file->beginning(), first + second.substr(0, 96));
  EXPECT_EQ(SlurpFile(file->path()), first + second);
}

TEST(SpoolFile, IsRemovedWithItsLastOwner) {
  const TempDir folder;
  std::filesystem::path path;
  {
    auto file = SpoolFile::Create(folder.path());
    ASSERT_TRUE(file);
    const SpoolFile owner = *std::move(file);
    path = owner.path();
    EXPECT_TRUE(std::filesystem::exists(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(SpoolFile, NeedsItsFolder) {
  const TempDir folder;
  EXPECT_EQ(SpoolFile::Create(folder / "missing").error().kind, "storage");
}

}  // namespace
}  // namespace farhorizon
