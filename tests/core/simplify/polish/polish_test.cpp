#include "core/simplify/polish/polish.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <stop_token>

#include <gtest/gtest.h>

#include "core/simplify/order/collapser.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/half_edge_checks.h"
#include "tests/support/level_objective.h"
#include "tests/support/small_terrains.h"
#include "tests/support/workbench.h"

namespace farhorizon {
namespace {

constexpr float kSlopeWeight = 0.1F;

using Step = Status (*)(Workpiece&, const RunControl&);

// Sets the prices and the rules of levels that are not exact.
void BeginLevels(Workpiece& work) {
  work.rules.BeginSoft(work.mesh);
  work.price.AllowRises(true);
  work.price.SetWeight(static_cast<float>(30 * work.skyline.PostsPerLine()));
  work.mesh.measure().SetSlopeWeight(kSlopeWeight);
  work.mesh.MeasureAll();
}

void Coarsen(Workbench& bench, int part) {
  Workpiece& work = bench.work;
  BeginLevels(work);
  Collapser collapser(work);
  for (std::int32_t v = 0; v < work.mesh.vertices(); ++v) collapser.Consider(v);
  ASSERT_TRUE(collapser.Run(work.mesh.triangles() / part, {}, [] {}));
}

double SumOf(const Workbench& bench) {
  return ObjectiveOf(bench.work, bench.work.mesh, kSlopeWeight,
                     30 * bench.work.skyline.PostsPerLine())
      .least;
}

class Polish : public testing::TestWithParam<Step> {};

TEST_P(Polish, LowersTheSumAndKeepsTheMeshSound) {
  std::mt19937 random(1);
  double before = 0;
  double after = 0;
  int higher = 0;
  int lower = 0;
  for (int round = 0; round < Rounds(600); ++round) {
    Workbench bench(AnySmallDem(18, random));
    Coarsen(bench, 3);
    const std::int32_t triangles = bench.work.mesh.triangles();
    const double was = SumOf(bench);
    ASSERT_TRUE(GetParam()(bench.work, {}));
    const double is = SumOf(bench);
    ASSERT_EQ(FaultOfMesh(bench.work.mesh), "") << DrawAscii(bench.dem);
    ASSERT_EQ(bench.work.mesh.triangles(), triangles);
    // In shares, so that a cliff of 2^20 does not stand for all.
    before += 1;
    after += (1 + is) / (1 + was);
    higher += static_cast<int>(is > was * 1.001 + 0.01);
    lower += static_cast<int>(is < was * 0.999 - 0.01);
  }
  EXPECT_LT(after, 0.997 * before);
  EXPECT_GT(lower, Rounds(60));
  EXPECT_LE(higher, Rounds(6));  // where too low a height was taken for what is left on a line
}

TEST_P(Polish, LeavesAMeshOfAllTrianglesAlone) {
  std::mt19937 random(5);
  for (int round = 0; round < Rounds(200); ++round) {
    Workbench bench(AnySmallDem(14, random));
    Workpiece& work = bench.work;
    BeginLevels(work);
    const HalfEdgeMesh before = work.mesh;
    ASSERT_TRUE(GetParam()(work, {}));
    for (std::int32_t v = 0; v < before.vertices(); ++v) {
      ASSERT_EQ(work.mesh.at(v).x, before.at(v).x);
      ASSERT_EQ(work.mesh.at(v).y, before.at(v).y);
      ASSERT_EQ(work.mesh.at(v).plan, before.at(v).plan) << DrawAscii(bench.dem);
    }
    for (std::int32_t h = 0; h < before.half_edges(); ++h) {
      ASSERT_EQ(work.mesh.origin(h), before.origin(h)) << DrawAscii(bench.dem);
    }
  }
}

TEST_P(Polish, StopsWhenAStopIsRequested) {
  std::mt19937 random(2);
  Workbench bench(AnySmallDem(14, random));
  std::stop_source source;
  source.request_stop();
  RunControl control;
  control.stop = source.get_token();
  const Status status = GetParam()(bench.work, control);
  ASSERT_FALSE(status);
}

INSTANTIATE_TEST_SUITE_P(EveryStep, Polish, testing::Values(FlipEdges, MoveVertices, FitHeights));

TEST(FitHeights, LeavesWhatIsHeldAlone) {
  std::mt19937 random(3);
  int fitted = 0;
  for (int round = 0; round < Rounds(300); ++round) {
    Workbench bench(AnySmallDem(12, random));
    Coarsen(bench, 2);
    const HalfEdgeMesh before = bench.work.mesh;
    ASSERT_TRUE(FitHeights(bench.work, {}));
    for (std::int32_t v = 0; v < before.vertices(); ++v) {
      if (!before.IsVertex(v)) continue;
      const Place& from = before.at(v);
      const Place& to = bench.work.mesh.at(v);
      ASSERT_EQ(from.x, to.x);
      ASSERT_EQ(from.y, to.y);
      if (bench.ground.OnSide(from) || before.IsKnotted(v)) {
        ASSERT_EQ(from.plan, to.plan);
      }
      fitted += static_cast<int>(from.plan != to.plan);
    }
  }
  EXPECT_GT(fitted, Rounds(500));
}

TEST(MoveVertices, MovesByThreePostsAtMostAndNothingOnARim) {
  std::mt19937 random(4);
  int moved = 0;
  for (int round = 0; round < Rounds(300); ++round) {
    Workbench bench(AnySmallDem(18, random));
    Coarsen(bench, 3);
    const HalfEdgeMesh before = bench.work.mesh;
    ASSERT_TRUE(MoveVertices(bench.work, {}));
    std::set<VertexId> posts;
    for (std::int32_t v = 0; v < before.vertices(); ++v) {
      if (!before.IsVertex(v)) continue;
      const Place& from = before.at(v);
      const Place& to = bench.work.mesh.at(v);
      const bool stays = from.x == to.x && from.y == to.y;
      if (before.IsKnotted(v) || before.OnRim(v)) {
        ASSERT_TRUE(stays);
      }
      ASSERT_LE(std::max(std::abs(from.x - to.x), std::abs(from.y - to.y)), 3);
      ASSERT_TRUE(posts.insert(bench.ground.PostAt(to)).second) << "two vertices on one post";
      moved += static_cast<int>(!stays);
    }
  }
  EXPECT_GT(moved, Rounds(100));
}

}  // namespace
}  // namespace farhorizon
