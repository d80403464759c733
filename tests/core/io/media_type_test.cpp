#include "core/io/media_type.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(MediaTypeOf, KnowsEveryArtifact) {
  EXPECT_EQ(MediaTypeOf("lod0.glb"), "model/gltf-binary");
  EXPECT_EQ(MediaTypeOf("horizon.geojson"), "application/geo+json");
  EXPECT_EQ(MediaTypeOf("tileset.json"), "application/json");
  EXPECT_EQ(MediaTypeOf("report.html"), "text/html");
  EXPECT_EQ(MediaTypeOf("what"), "application/octet-stream");
}

}  // namespace
}  // namespace farhorizon
