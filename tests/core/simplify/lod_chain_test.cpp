#include "core/simplify/lod_chain.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <stop_token>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/level_checks.h"
#include "tests/support/small_terrains.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

struct Chain {
  Chain(const Dem& of, const LodPlan& plan, const RunControl& control = {})
      : dem(of), terrain(*Terrain::Build(dem)), horizon(*FindHorizon(terrain, {}, {})) {
    levels = *BuildLodChain(terrain, horizon, plan, control);
  }
  Dem dem;
  Terrain terrain;
  Horizon horizon;
  std::vector<Lod> levels;
};

std::string FaultOfLevels(const Terrain& terrain, const Horizon& horizon,
                          const std::vector<Lod>& levels) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::string fault =
        FaultOfLevel(terrain, horizon, levels[i], i == 0 ? nullptr : &levels[i - 1].kept);
    if (!fault.empty()) return fault + ", level " + std::to_string(i);
    if (i > 0 && levels[i].mesh.triangles.size() > levels[i - 1].mesh.triangles.size()) {
      return "more triangles than the finer one, level " + std::to_string(i);
    }
  }
  return "";
}

void ExpectSound(const Chain& chain) {
  ASSERT_EQ(FaultOfLevels(chain.terrain, chain.horizon, chain.levels), "") << DrawAscii(chain.dem);
}

// From all triangles down to one.
std::vector<std::int64_t> Falling(std::int64_t full) {
  std::vector<std::int64_t> triangles;
  for (const int part : {1, 2, 5, 10, 20, 50}) {
    const std::int64_t next = full / part;
    if (next > 1 && (triangles.empty() || next < triangles.back())) triangles.push_back(next);
  }
  triangles.push_back(1);
  return triangles;
}

TEST(LodChain, EveryLevelCoversTheDomainAndNestsOnAnySmallTerrain) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(1500); ++round) {
    const Dem dem = AnySmallDemInQuanta(13, random);
    LodPlan plan;
    plan.triangles = Falling(std::ssize(Terrain::Build(dem)->Triangles()));
    plan.row_bend = round % 4 * 0.05;
    const Chain chain(dem, plan);
    ASSERT_EQ(chain.levels.size(), plan.triangles.size());
    SCOPED_TRACE(round);
    ExpectSound(chain);
    if (HasFatalFailure()) return;
  }
}

TEST(LodChain, ALevelOfAllTrianglesIsTheDem) {
  std::mt19937 random(7);
  for (int round = 0; round < Rounds(40); ++round) {
    const Dem dem = AnySolidLandscape(24, 50, random);
    LodPlan plan;
    const std::vector<Triangle> triangles = Terrain::Build(dem)->Triangles();
    plan.triangles = {std::ssize(triangles)};
    plan.column_bend = round % 3 * 0.05;
    const Chain chain(dem, plan);
    const PostMesh& mesh = chain.levels[0].mesh;
    ASSERT_EQ(mesh.triangles.size(), triangles.size()) << DrawAscii(dem);
    for (std::size_t k = 0; k < mesh.posts.size(); ++k) {
      ASSERT_NEAR(mesh.heights_m[k], dem.HeightM(mesh.posts[k]), 1e-4) << DrawAscii(dem);
    }
    const auto corners = [](Triangle t) {
      std::sort(t.begin(), t.end());
      return t;
    };
    std::set<Triangle> of_terrain;
    for (const Triangle& t : triangles) of_terrain.insert(corners(t));
    for (const Triangle& t : mesh.triangles) {
      ASSERT_TRUE(of_terrain.contains(corners(t))) << DrawAscii(dem);
    }
  }
}

TEST(LodChain, EveryLevelCoversTheDomainAndNestsOnLandscapes) {
  std::mt19937 random(2);
  for (int round = 0; round < Rounds(25); ++round) {
    const Dem dem = AnySolidLandscape(24, 60, random);
    LodPlan plan;
    plan.max_error_m = 5;
    if (round % 2 == 0) plan.triangles = Falling(std::ssize(Terrain::Build(dem)->Triangles()));
    SCOPED_TRACE(round);
    ExpectSound(Chain(dem, plan));
    if (HasFatalFailure()) return;
  }
}

// Triangles that the level would have without its vertices inside: each stands for two.
std::int64_t LeastTriangles(const Lod& level) {
  const std::set<Edge> outline = OutlineOf(level.mesh.triangles);
  std::set<VertexId> rim;
  for (const Edge& edge : outline) rim.insert({edge.a, edge.b});
  const auto inside = std::ssize(level.mesh.posts) - std::ssize(rim);
  return std::ssize(level.mesh.triangles) - 2 * inside;
}

TEST(LodChain, HoldsABudgetOfTrianglesOrHasNothingButItsOutline) {
  std::mt19937 random(3);
  int held = 0;
  int outlines = 0;
  for (int round = 0; round < Rounds(25); ++round) {
    const Dem dem = AnySolidLandscape(24, 50, random);
    LodPlan plan;
    plan.triangles = Falling(std::ssize(Terrain::Build(dem)->Triangles()));
    const Chain chain(dem, plan);
    for (std::size_t i = 0; i < chain.levels.size(); ++i) {
      const auto found = std::ssize(chain.levels[i].mesh.triangles);
      if (found <= plan.triangles[i]) {
        ++held;
        continue;
      }
      ++outlines;
      ASSERT_LE(found, 1.2 * static_cast<double>(LeastTriangles(chain.levels[i])) + 8)
          << plan.triangles[i] << " asked, level " << i << "\n"
          << DrawAscii(dem);
    }
  }
  EXPECT_GT(held, Rounds(50));
  EXPECT_GT(outlines, Rounds(5));
}

TEST(LodChain, BySizeHasFiveLevelsOfTwoFifthsEachDownToFiveHundredTriangles) {
  const Chain chain(FractalDem(81, 4000, 100, 7), {});
  ASSERT_GE(chain.levels.size(), 3U);
  EXPECT_TRUE(chain.levels[0].exact);
  for (std::size_t i = 1; i < chain.levels.size(); ++i) {
    const auto finer = static_cast<double>(chain.levels[i - 1].mesh.triangles.size());
    const auto found = static_cast<double>(chain.levels[i].mesh.triangles.size());
    EXPECT_LE(found, 0.4 * finer);
    EXPECT_GE(found, 0.4 * finer - 60);
    EXPECT_GE(found, 440);
    EXPECT_FALSE(chain.levels[i].exact);
  }
  LodPlan two;
  two.levels = 2;
  EXPECT_EQ(Chain(FractalDem(81, 4000, 100, 7), two).levels.size(), 2U);
}

TEST(LodChain, IsTheSameOnASecondRun) {
  std::mt19937 random(4);
  for (int round = 0; round < Rounds(12); ++round) {
    const Dem dem = AnySolidLandscape(10, 40, random);
    LodPlan plan;
    if (round % 2 == 0) plan.triangles = Falling(std::ssize(Terrain::Build(dem)->Triangles()));
    const Chain one(dem, plan);
    const Chain two(dem, plan);
    ASSERT_EQ(one.levels.size(), two.levels.size());
    for (std::size_t i = 0; i < one.levels.size(); ++i) {
      ASSERT_EQ(one.levels[i].mesh.posts, two.levels[i].mesh.posts);
      ASSERT_EQ(one.levels[i].mesh.heights_m, two.levels[i].mesh.heights_m);
      ASSERT_EQ(one.levels[i].mesh.triangles, two.levels[i].mesh.triangles);
      ASSERT_EQ(one.levels[i].kept, two.levels[i].kept);
    }
  }
}

TEST(LodChain, StopsSoonWhenAStopIsRequested) {
  const Dem dem = FractalDem(129, 4000, 120, 9);
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  for (const double at : {0.0, 0.1, 0.5}) {
    std::stop_source source;
    RunControl control;
    control.stop = source.get_token();
    double stopped = 0;
    double last = 0;
    control.progress = [&](Stage, double done) {
      last = done;
      if (done < at || source.stop_requested()) return;
      stopped = done;
      source.request_stop();
    };
    Result<std::vector<Lod>> levels = BuildLodChain(terrain, horizon, {}, control);
    ASSERT_FALSE(levels) << "stopped at " << at;
    EXPECT_EQ(levels.error().code, ErrorCode::kCancelled);
    EXPECT_LT(last, stopped + 0.15);  // the first look for a stop may be a step later
  }
}

TEST(LodChain, ProgressRisesFromZeroToOne) {
  for (const std::int32_t side : {2, 20, 97}) {  // the smaller ones end before their fifth level
    std::vector<double> reported;
    RunControl control;
    control.progress = [&](Stage stage, double done) {
      EXPECT_EQ(stage, Stage::kSimplify);
      reported.push_back(done);
    };
    const Chain chain(FractalDem(side, 2000, 100, 3), {}, control);
    ASSERT_FALSE(reported.empty());
    EXPECT_EQ(reported.front(), 0);
    EXPECT_EQ(reported.back(), 1);
    EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
    EXPECT_LT(reported.size(), 200U);
    EXPECT_GT(reported.size(), side == 97 ? 12U : 2U);
  }
}

TEST(LodChain, ALevelSeaIsFinerWhereTheEarthCurves) {
  const Dem sea = MakeDem(65, 65, [](std::int32_t, std::int32_t) { return 0; });
  LodPlan flat;
  flat.triangles = {200};
  LodPlan curved = flat;
  curved.column_bend = 0.05;
  curved.row_bend = 0.05;
  const Chain without(sea, flat);
  const Chain with(sea, curved);
  // A grid of 10 x 10 cells of 6.4 posts would be off by 2 x 0.05 x 3.2^2 = 1 m; sides, which know
  // nothing of the Earth, have a quarter of their posts.
  EXPECT_LT(GreatestErrorOf(with.terrain, with.levels[0].mesh, curved), 8);
  EXPECT_GT(GreatestErrorOf(without.terrain, without.levels[0].mesh, curved), 20);
}

TEST(LodChain, HeightsKeepTheirDigitsFarFromZero) {
  Dem dem = FractalDem(33, 300, 100, 5);
  const Chain near(dem, {});
  dem.height_offset_m = 1e6;
  const Chain far(dem, {});
  ASSERT_EQ(near.levels.size(), far.levels.size());
  for (std::size_t i = 0; i < near.levels.size(); ++i) {
    ASSERT_EQ(near.levels[i].mesh.posts, far.levels[i].mesh.posts);
    for (std::size_t k = 0; k < near.levels[i].mesh.posts.size(); ++k) {
      ASSERT_NEAR(near.levels[i].mesh.heights_m[k] + 1e6, far.levels[i].mesh.heights_m[k], 1e-6);
    }
  }
}

struct HardGround {
  const char* name;
  Dem dem;
};

std::vector<HardGround> HardGrounds() {
  std::mt19937 random(6);
  const auto any = [&random](std::int32_t bound) {
    return static_cast<std::int32_t>(random() % static_cast<unsigned>(bound));
  };
  constexpr int kSide = GridSide(121);
  std::vector<HardGround> all;
  all.push_back({"flat", MakeDem(kSide, kSide, [](std::int32_t, std::int32_t) { return 3; })});
  all.push_back({"slope", MakeDem(kSide, 2 * kSide / 3,
                                  [](std::int32_t c, std::int32_t r) { return 7 * c - r; })});
  all.push_back(
      {"noise", MakeDem(kSide, kSide, [&](std::int32_t, std::int32_t) { return any(1000); })});
  all.push_back({"peaks", MakeDem(kSide, kSide, [](std::int32_t c, std::int32_t r) {
                   return c % 2 == 1 && r % 2 == 1 ? 9 : 0;
                 })});
  all.push_back(
      {"saw", MakeDem(kSide, kSide, [](std::int32_t c, std::int32_t) { return c % 2 * 50; })});
  all.push_back(
      {"strip", MakeDem(2, 30 * kSide, [&](std::int32_t, std::int32_t) { return any(50); })});
  all.push_back(
      {"level strip", MakeDem(30 * kSide, 2, [](std::int32_t, std::int32_t) { return 1; })});
  all.push_back({"holes", MakeDem(kSide, kSide, [&](std::int32_t, std::int32_t) {
                   return any(4) == 0 ? kNoHeight : any(1000);
                 })});
  all.push_back({"bowl", MakeDem(kSide, kSide, [](std::int32_t c, std::int32_t r) {
                   return (c - kSide / 2) * (c - kSide / 2) + (r - kSide / 2) * (r - kSide / 2);
                 })});
  all.push_back({"cliff", MakeDem(kSide, kSide, [](std::int32_t c, std::int32_t r) {
                   return c + r > kSide ? 1 << 22 : c % 3;
                 })});
  return all;
}

TEST(LodChain, HardGroundTakesBoundedTimeAndGivesSoundMeshes) {
  for (const HardGround& hard : HardGrounds()) {
    SCOPED_TRACE(hard.name);
    const Terrain terrain = *Terrain::Build(hard.dem);
    HorizonOptions few;  // white noise and forests of spikes are hard without end
    few.approximate = true;
    few.work_budget = 1000000;
    const Horizon horizon = *FindHorizon(terrain, few, {});
    for (const bool by_size : {true, false}) {
      LodPlan plan;
      plan.max_error_m = 1;
      if (!by_size) plan.triangles = Falling(std::ssize(terrain.Triangles()));
      const auto begin = std::chrono::steady_clock::now();
      const Result<std::vector<Lod>> levels = BuildLodChain(terrain, horizon, plan, {});
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
      ASSERT_TRUE(levels);
      ASSERT_EQ(FaultOfLevels(terrain, horizon, *levels), "");
      // A hundred times what ground takes, on a slow machine.
      EXPECT_LT(took.count(), 60) << (by_size ? "by size" : "by triangles");
      RecordProperty(std::string(hard.name) + (by_size ? " by size" : " by triangles"),
                     std::to_string(took.count()));
    }
  }
}

TEST(LodChain, ALevelPlaneBecomesNothingButItsSides) {
  const Dem dem = MakeDem(60, 40, [](std::int32_t c, std::int32_t r) { return 2 * c + 3 * r; });
  LodPlan plan;
  plan.triangles = {2};
  const Chain chain(dem, plan);
  for (std::size_t k = 0; k < chain.levels[0].mesh.posts.size(); ++k) {
    const VertexId v = chain.levels[0].mesh.posts[k];
    EXPECT_TRUE(OnSide(dem, v));
    EXPECT_NEAR(chain.levels[0].mesh.heights_m[k], dem.HeightM(v), 1e-3);
  }
}

}  // namespace
}  // namespace farhorizon
