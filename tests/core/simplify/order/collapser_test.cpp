#include "core/simplify/order/collapser.h"

#include <stop_token>

#include <gtest/gtest.h>

#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/half_edge_checks.h"
#include "tests/support/small_terrains.h"
#include "tests/support/terrains.h"
#include "tests/support/workbench.h"

namespace farhorizon {
namespace {

struct CollapserBench : Workbench {
  explicit CollapserBench(const Dem& of) : Workbench(of), collapser(work) {
    work.rules.BeginSoft(work.mesh);
    work.price.AllowRises(true);
    work.price.SetWeight(30);
  }
  void ConsiderAll() {
    for (std::int32_t v = 0; v < work.mesh.vertices(); ++v) collapser.Consider(v);
  }
  Collapser collapser;
};

TEST(Collapser, LeavesTwoTrianglesOfAPlane) {
  CollapserBench bench(
      MakeDem(17, 9, [](std::int32_t c, std::int32_t r) { return 3 * c - 2 * r; }));
  bench.ConsiderAll();
  ASSERT_TRUE(bench.collapser.Run(2, {}, [] {}));
  EXPECT_EQ(bench.work.mesh.triangles(), 2);
  EXPECT_EQ(FaultOfMesh(bench.work.mesh), "");
}

TEST(Collapser, StopsAtTheBudgetAndKeepsWhatStays) {
  std::mt19937 random(1);
  int held = 0;
  for (int round = 0; round < Rounds(800); ++round) {
    CollapserBench bench(AnySmallDem(12, random));
    HalfEdgeMesh& mesh = bench.work.mesh;
    std::vector<std::int32_t> staying;
    for (std::int32_t v = 0; v < mesh.vertices(); ++v) {
      if (!mesh.IsVertex(v) || random() % 4 > 0) continue;
      bench.work.stays[static_cast<std::size_t>(v)] = true;
      staying.push_back(v);
    }
    const auto budget = static_cast<std::int32_t>(mesh.triangles() / 2);
    bench.ConsiderAll();
    ASSERT_TRUE(bench.collapser.Run(budget, {}, [] {}));
    ASSERT_EQ(FaultOfMesh(mesh), "") << DrawAscii(bench.dem);
    for (const std::int32_t v : staying) ASSERT_TRUE(mesh.IsVertex(v)) << DrawAscii(bench.dem);
    if (mesh.triangles() > budget) continue;
    ASSERT_GE(mesh.triangles(), budget - 1);  // a collapse takes two triangles at most
    ++held;
  }
  EXPECT_GT(held, Rounds(200));
}

TEST(Collapser, TakesTheFlatBeforeTheSummit) {
  CollapserBench bench(
      MakeDem(15, 15, [](std::int32_t c, std::int32_t r) { return c == 6 && r == 7 ? 500 : 0; }));
  bench.ConsiderAll();
  ASSERT_TRUE(bench.collapser.Run(14, {}, [] {}));
  EXPECT_LE(bench.work.mesh.triangles(), 14);
  EXPECT_TRUE(bench.work.mesh.IsVertex(7 * 15 + 6));
}

TEST(Collapser, ForcesAVertexWhateverItCosts) {
  CollapserBench bench(
      MakeDem(5, 5, [](std::int32_t c, std::int32_t r) { return c == 2 && r == 2 ? 9 : 0; }));
  EXPECT_TRUE(bench.collapser.Force(12));
  EXPECT_FALSE(bench.work.mesh.IsVertex(12));
  EXPECT_FALSE(bench.collapser.Force(0));  // a corner
  EXPECT_TRUE(bench.work.mesh.IsVertex(0));
  EXPECT_EQ(FaultOfMesh(bench.work.mesh), "");
}

TEST(Collapser, StopsWhenAStopIsRequested) {
  CollapserBench bench(FractalDem(65, 900, 100, 3));
  std::stop_source source;
  source.request_stop();
  RunControl control;
  control.stop = source.get_token();
  bench.ConsiderAll();
  Status status = bench.collapser.Run(2, control, [] {});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace farhorizon
