#include "core/pipeline/mesh_orientation.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// About a point at 60 degrees of latitude on the meridian of Greenwich.
TangentFrame Frame() { return {{0, 60, 0}, {3197104.587, 0, 5500477.134}}; }

LocalMesh MeshOfPlaces(const Enu& a, const Enu& b, const Enu& c) {
  LocalMesh mesh;
  mesh.positions = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(AllTurnLeft, TellsCounterClockwiseFromClockwiseAndFlat) {
  EXPECT_TRUE(AllTurnLeft(MeshOfPlaces({0, 0, 5}, {10, 0, 5}, {0, 10, 90}), Frame()));
  EXPECT_FALSE(AllTurnLeft(MeshOfPlaces({0, 0, 5}, {0, 10, 90}, {10, 0, 5}), Frame()));
  EXPECT_FALSE(AllTurnLeft(MeshOfPlaces({0, 0, 5}, {10, 0, 5}, {20, 0, 5}), Frame()));
}

TEST(AllTurnLeft, LooksAlongTheVerticalOfThePlace) {
  // 400 km north of the frame's origin the vertical leans north by 3.6 degrees, so the frame sees
  // a wall that leans 2 degrees from its own vertical from the other side.
  const Enu a = {0, 400000, -12500};
  const Enu b = {1000, 400000, -12500};
  const Enu c = {0, 400000 + 35, -12500 + 1000};
  EXPECT_FALSE(AllTurnLeft(MeshOfPlaces(a, b, c), Frame()));
  EXPECT_TRUE(AllTurnLeft(MeshOfPlaces(a, c, b), Frame()));
}

}  // namespace
}  // namespace farhorizon
