#include "core/io/files.h"

#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

// FIPS 180-2, appendix B.
TEST(Sha256Hex, AgreesWithTheStandardsExamples) {
  EXPECT_EQ(Sha256Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256Hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(Sha256Hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256OfFile, IsThatOfItsBytesHoweverMany) {
  const TempDir dir;
  const std::string bytes(1'000'000, 'a');
  SpillFile(dir / "a", bytes);
  Result<std::string> sum = Sha256OfFile(dir / "a");
  ASSERT_TRUE(sum);
  EXPECT_EQ(*sum, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(*sum, Sha256Hex(bytes));
  EXPECT_EQ(Sha256OfFile(dir / "b").error().code, ErrorCode::kNotFound);
}

TEST(ReadFile, GivesBackWhatWasWritten) {
  const TempDir dir;
  const std::string bytes("a\0b\n", 4);
  ASSERT_TRUE(WriteFile(dir / "a", bytes));
  Result<std::string> back = ReadFile(dir / "a");
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, bytes);
}

TEST(ReadFile, RefusesMoreThanItMayTake) {
  const TempDir dir;
  SpillFile(dir / "a", "12345");
  EXPECT_TRUE(ReadFile(dir / "a", 5));
  EXPECT_EQ(ReadFile(dir / "a", 4).error().code, ErrorCode::kResourceExhausted);
}

TEST(ReadFile, RefusesFoldersAndNamesNoFolderInItsMessage) {
  const TempDir dir;
  Result<std::string> read = ReadFile(dir.path());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kIo);
  read = ReadFile(dir / "missing");
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, ::testing::Not(::testing::HasSubstr(dir.path().string())));
}

TEST(WriteFile, ReplacesWhatWasThereAndLeavesNothingBeside) {
  const TempDir dir;
  ASSERT_TRUE(WriteFile(dir / "a", "old"));
  ASSERT_TRUE(WriteFile(dir / "a", "new"));
  EXPECT_EQ(SlurpFile(dir / "a"), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 1);
}

TEST(WriteFile, FailsWhereTheFolderIsMissing) {
  const TempDir dir;
  Status written = WriteFile(dir / "no/such/file", "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kNotFound);
}

TEST(WriteFile, LeavesTheOldFileWhereTheTargetCannotBeReplaced) {
  const TempDir dir;
  std::filesystem::create_directory(dir / "a");
  EXPECT_FALSE(WriteFile(dir / "a", "x"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 1);
}

TEST(MediaTypeOf, KnowsEveryArtifact) {
  EXPECT_EQ(MediaTypeOf("lod0.glb"), "model/gltf-binary");
  EXPECT_EQ(MediaTypeOf("horizon.geojson"), "application/geo+json");
  EXPECT_EQ(MediaTypeOf("tileset.json"), "application/json");
  EXPECT_EQ(MediaTypeOf("what"), "application/octet-stream");
}

TEST(Manifest, ReadsBackWhatItWrote) {
  const std::vector<ManifestEntry> entries = {{"lod0.glb", "model/gltf-binary", 12, Sha256Hex("x")},
                                              {"report.json", "application/json", 0, ""}};
  Result<std::vector<ManifestEntry>> back = ReadManifest(WriteManifest(entries));
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), 2U);
  EXPECT_EQ((*back)[0].name, "lod0.glb");
  EXPECT_EQ((*back)[0].media_type, "model/gltf-binary");
  EXPECT_EQ((*back)[0].bytes, 12U);
  EXPECT_EQ((*back)[0].sha256, Sha256Hex("x"));
}

TEST(Manifest, RefusesWhatIsNoManifest) {
  for (const char* text : {"", "{", "[]", "{\"artifacts\": [{\"name\": 3}]}"}) {
    EXPECT_FALSE(ReadManifest(text)) << text;
  }
}

}  // namespace
}  // namespace farhorizon
