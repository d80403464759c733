#include "service/pages/asset_folder.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/sha256.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using testing::ElementsAre;
using testing::Key;

class AssetFolderTest : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(cesium_ / "Workers");
    SpillFile(cesium_ / "Cesium.js", "main");
    SpillFile(cesium_ / "Workers" / "decode.js", "worker");
    SpillFile(folder_ / "secret", "secret");
  }

  TempDir folder_;
  const std::filesystem::path cesium_ = folder_ / "cesium";
};

TEST_F(AssetFolderTest, ListsWhatItHasAndNothingElse) {
  std::filesystem::create_symlink(folder_ / "secret", cesium_ / "link.js");
  std::filesystem::create_directory_symlink(folder_.path(), cesium_ / "up");
  const Result<AssetFolder> read = AssetFolder::Read(cesium_);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_THAT(read->assets(), ElementsAre(Key("Cesium.js"), Key("Workers/decode.js")));
  const Asset* asset = read->Find("Workers/decode.js");
  ASSERT_NE(asset, nullptr);
  EXPECT_EQ(asset->bytes, 6);
  EXPECT_EQ(asset->sha256, Sha256Hex("worker"));
  for (const char* name : {"", ".", "..", "/", "../secret", "Workers", "Workers/", "/Cesium.js",
                           "./Cesium.js", "Workers/../Cesium.js", "link.js", "up/secret"}) {
    EXPECT_EQ(read->Find(name), nullptr) << name;
  }
}

TEST_F(AssetFolderTest, HasAnotherFingerprintForOtherFiles) {
  const std::string first = AssetFolder::Read(cesium_)->fingerprint();
  EXPECT_EQ(first, AssetFolder::Read(cesium_)->fingerprint());
  EXPECT_EQ(first.size(), 16U);
  SpillFile(cesium_ / "Workers" / "decode.js", "other!");
  EXPECT_NE(first, AssetFolder::Read(cesium_)->fingerprint());
  SpillFile(cesium_ / "Workers" / "decode.js", "worker");
  std::filesystem::rename(cesium_ / "Workers" / "decode.js", cesium_ / "Workers" / "d.js");
  EXPECT_NE(first, AssetFolder::Read(cesium_)->fingerprint());
}

TEST_F(AssetFolderTest, IsTheOneOfCesiumJs) {
  EXPECT_EQ(AssetFolder::Read(folder_.path()).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(AssetFolder::Read(folder_ / "none").error().code, ErrorCode::kNotFound);
}

TEST_F(AssetFolderTest, OpensNothingThatHasChanged) {
  const AssetFolder read = *AssetFolder::Read(cesium_);
  const Asset& main = *read.Find("Cesium.js");
  EXPECT_TRUE(OpenAsset(main));
  SpillFile(cesium_ / "Cesium.js", "longer");
  EXPECT_FALSE(OpenAsset(main));
  std::filesystem::remove(cesium_ / "Cesium.js");
  EXPECT_FALSE(OpenAsset(main));
  std::filesystem::create_symlink(folder_ / "secret", cesium_ / "Cesium.js");
  EXPECT_FALSE(OpenAsset(main));
}

TEST(AssetMediaType, IsWhatBrowsersAskFor) {
  EXPECT_EQ(AssetMediaType("Workers/a.js"), "text/javascript; charset=utf-8");
  EXPECT_EQ(AssetMediaType("ThirdParty/draco_decoder.wasm"), "application/wasm");
  EXPECT_EQ(AssetMediaType("a.json"), "application/json");
  EXPECT_EQ(AssetMediaType("a.ktx2"), "application/octet-stream");
}

}  // namespace
}  // namespace farhorizon
