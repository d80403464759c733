#include "core/simplify/order/collapse_log.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/half_edge_checks.h"
#include "tests/support/random_operations.h"
#include "tests/support/small_terrains.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

// Collapses the vertex onto the neighbour, where both stand side by side and it may be done.
bool CollapseOnto(HalfEdgeMesh& mesh, const Pair& pair, CollapseLog* log) {
  Ring ring;
  if (!mesh.IsVertex(pair.first) || !mesh.Gather(pair.first, ring)) return false;
  for (std::int32_t j = 0; j < ring.count; ++j) {
    if (ring.id(j) != pair.second || !MayCollapse(mesh, ring, j)) continue;
    if (log != nullptr) log->Record(ring, j);
    mesh.Collapse(ring, pair.second);
    return true;
  }
  return false;
}

std::vector<Pair> CollapseAtRandom(HalfEdgeMesh& mesh, CollapseLog& log, int tries,
                                   std::mt19937& random) {
  std::vector<Pair> done;
  Ring ring;
  for (int i = 0; i < tries; ++i) {
    const auto v = static_cast<std::int32_t>(random() % static_cast<unsigned>(mesh.vertices()));
    if (!mesh.IsVertex(v) || !mesh.Gather(v, ring)) continue;
    const Pair pair = {v, ring.id(static_cast<std::int32_t>(random()) & 1 ? 0 : ring.count / 2)};
    if (CollapseOnto(mesh, pair, &log)) done.push_back(pair);
  }
  return done;
}

// The slow twin: all collapses but those that were taken back, from the beginning.
TEST(CollapseLog, WhatIsTakenBackWasNeverDone) {
  std::mt19937 random(1);
  int taken = 0;
  int alone = 0;
  for (int round = 0; round < Rounds(1500); ++round) {
    const Dem dem = AnySmallDem(10, random);
    const Terrain terrain = *Terrain::Build(dem);
    const Ground ground(terrain, {});
    HalfEdgeMesh mesh(ground);
    CollapseLog log;
    log.Begin(mesh);
    std::vector<Pair> left = CollapseAtRandom(mesh, log, 200, random);
    for (int k = 0; k < 6; ++k) {
      const auto triangle =
          static_cast<std::int32_t>(random() % static_cast<unsigned>(mesh.half_edges() / 3));
      const std::int32_t last = mesh.Stands(triangle) ? log.LastAt(triangle) : CollapseLog::kNone;
      if (last == CollapseLog::kNone) continue;
      std::vector<Pair> back;
      log.TakeBack(mesh, last, back);
      taken += static_cast<int>(back.size());
      alone += static_cast<int>(back.size() == 1);
      for (const Pair& pair : back) {
        // A vertex that was taken back and went again is in the list twice.
        const auto at = std::find(left.rbegin(), left.rend(), pair);
        ASSERT_NE(at, left.rend());
        left.erase(std::next(at).base());
      }
      HalfEdgeMesh twin(ground);
      for (const Pair& pair : left) ASSERT_TRUE(CollapseOnto(twin, pair, nullptr));
      ASSERT_EQ(TrianglesOf(mesh), TrianglesOf(twin)) << DrawAscii(dem);
      ASSERT_EQ(FaultOfMesh(mesh), "") << DrawAscii(dem);
      const std::vector<Pair> more = CollapseAtRandom(mesh, log, 10, random);
      left.insert(left.end(), more.begin(), more.end());
    }
  }
  EXPECT_GT(taken, Rounds(2000));
  EXPECT_GT(alone, Rounds(500));
}

TEST(CollapseLog, TakingBackTheFirstMayTakeAllThatBuildOnIt) {
  const Dem dem = FractalDem(33, 900, 100, 3);
  const Terrain terrain = *Terrain::Build(dem);
  const Ground ground(terrain, {});
  HalfEdgeMesh mesh(ground);
  const std::set<Corners> before = TrianglesOf(mesh);
  CollapseLog log;
  log.Begin(mesh);
  std::mt19937 random(7);
  ASSERT_GT(CollapseAtRandom(mesh, log, 20000, random).size(), 500U);
  std::vector<Pair> back;
  for (std::int32_t t = 0; t < mesh.half_edges() / 3; ++t) {
    while (log.LastAt(t) != CollapseLog::kNone) log.TakeBack(mesh, log.LastAt(t), back);
  }
  EXPECT_EQ(TrianglesOf(mesh), before);
  EXPECT_EQ(FaultOfMesh(mesh), "");
}

}  // namespace
}  // namespace farhorizon
