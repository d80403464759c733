#include "core/io/local_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(VerticesByPost, SortsByPostAndThenByVertex) {
  LocalMesh mesh;
  mesh.posts = {7, 3, 7, 0};
  EXPECT_THAT(VerticesByPost(mesh), ElementsAre(Pair(0, 3), Pair(3, 1), Pair(7, 0), Pair(7, 2)));
}

TEST(FaceNormal, PointsUpFromACounterClockwiseTriangleAndIsTwiceItsArea) {
  EXPECT_THAT(FaceNormal({1, 1, 5}, {4, 1, 5}, {1, 3, 5}), ElementsAre(0, 0, 6));
  EXPECT_THAT(FaceNormal({0, 0, 0}, {1, 0, 1}, {0, 1, 0}), ElementsAre(-1, 0, 1));
}

}  // namespace
}  // namespace farhorizon
