#include "core/io/manifest.h"

#include <gtest/gtest.h>

#include "core/io/sha256.h"

namespace farhorizon {
namespace {

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
