#include "core/pipeline/horizon_context.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/occluded_edges.h"
#include "core/io/horizon_features.h"
#include "core/pipeline/build.h"
#include "core/pipeline/report.h"
#include "core/pipeline/verify/verify.h"
#include "tests/support/progress_checks.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {
namespace {

constexpr int kApron = 3;

// Rough ground; in some, posts of the apron stand above all others.
TestRaster ContextGround(int columns, int rows, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> height(0, seed % 4 == 0 ? 2 : 40);
  TestRaster raster{.columns = columns, .rows = rows, .values = {}};
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const bool outside =
          std::min({c, r, columns - 1 - c, rows - 1 - r}) < kApron && (c + r) % 5 == 0;
      raster.values.push_back(height(random) + (outside && seed % 2 == 1 ? 15 : 0));
    }
  }
  return raster;
}

BuildOptions WithContext() {
  BuildOptions options;
  options.apron = kApron;
  options.horizon_context = true;
  options.vertical_datum = "ellipsoid";
  options.height_unit = "m";
  options.levels = 1;
  return options;
}

// An edge is in context where a line of sight touches it in the terrain with its apron: decided
// here edge by edge, over all edges.
TEST(HorizonContext, IsWhatEachEdgeByItselfIsInTheTerrainWithItsApron) {
  const TempDir folder;
  std::size_t in = 0;
  std::size_t out = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    WriteTiff(folder / "dem.tif", ContextGround(9 + static_cast<int>(seed % 7), 11, seed));
    const auto input = *TerrainInput::Open(folder / "dem.tif", WithContext(), {});
    const Horizon horizon = *FindHorizon(input->terrain(), {}, {});
    const std::vector<bool> found = *FindInContext(*input, horizon, {}, {});
    ASSERT_EQ(found.size(), horizon.edges.size());
    const Dem& dem = input->dem();
    const int wide = input->around().dem().columns;
    std::vector<Edge> ours;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto place = [&](VertexId v) {
        return (dem.Row(v) + kApron) * wide + dem.Column(v) + kApron;
      };
      ours.push_back({place(horizon.edges[i].edge.a), place(horizon.edges[i].edge.b)});
      EXPECT_EQ(CountOccluded(input->around(), {ours.back()}), found[i] ? 0 : 1) << seed;
      ++(found[i] ? in : out);
    }
    // No other edge of the tile is on the wider horizon.
    const Horizon wider = *FindHorizon(input->around(), {}, {});
    for (const HorizonEdge& e : wider.edges) {
      const auto inside = [&](VertexId v) {
        const int c = v % wide - kApron;
        const int r = v / wide - kApron;
        return c >= 0 && c < dem.columns && r >= 0 && r < dem.rows;
      };
      if (!inside(e.edge.a) || !inside(e.edge.b)) continue;
      EXPECT_TRUE(std::ranges::binary_search(ours, e.edge)) << seed;
    }
  }
  EXPECT_GT(in, 500U);
  EXPECT_GT(out, 500U);
}

TEST(HorizonContext, IsPublishedWithEachEdgeAndVerified) {
  const TempDir folder;
  WriteTiff(folder / "dem.tif", ContextGround(20, 18, 5));
  for (const HorizonDetail detail : {HorizonDetail::kEdges, HorizonDetail::kChains}) {
    BuildOptions options = WithContext();
    options.horizon_detail = detail;
    ASSERT_TRUE(BuildArtifacts(folder / "dem.tif", folder / "out", options, {}));
    const Report report = *ReadReport(SlurpFile(folder / "out" / "report.json"));
    ASSERT_TRUE(report.edges_in_context);
    EXPECT_GT(*report.edges_in_context, 0);
    EXPECT_LT(*report.edges_in_context, report.horizon_edges);
    const auto false_claims = [&] {
      std::vector<std::string> texts;
      BuildOptions stated;
      stated.vertical_datum = "ellipsoid";
      stated.height_unit = "m";
      const std::vector<ClaimCheck> claims =
          *VerifyArtifacts(folder / "dem.tif", folder / "out", stated, {});
      for (const ClaimCheck& check : claims) {
        if (!check.holds) texts.push_back(check.claim);
      }
      return texts;
    };
    EXPECT_EQ(false_claims(), std::vector<std::string>());
    std::string text = SlurpFile(folder / "out" / "horizon.geojson");
    const std::size_t at = text.find("\"context\":true");
    ASSERT_NE(at, std::string::npos);
    SpillFile(folder / "out" / "horizon.geojson", text.replace(at, 14, "\"context\":false"));
    EXPECT_TRUE(std::ranges::any_of(false_claims(), [](const std::string& claim) {
      return claim.find("context") != std::string::npos;
    }));
  }
}

// The horizon is found twice, and each stage of it is one all the same.
TEST(HorizonContext, LetsNoProgressFall) {
  const TempDir folder;
  WriteTiff(folder / "dem.tif", ContextGround(20, 18, 5));
  std::vector<ProgressReport> built;
  ASSERT_TRUE(BuildArtifacts(folder / "dem.tif", folder / "out", WithContext(),
                             {.progress = RecordInto(built)}));
  EXPECT_EQ(OffencesAgainstPlan(Workflow::kBuild, built), std::vector<std::string>());
  std::vector<ProgressReport> verified;
  ASSERT_TRUE(
      VerifyArtifacts(folder / "dem.tif", folder / "out", {}, {.progress = RecordInto(verified)}));
  EXPECT_EQ(OffencesAgainstPlan(Workflow::kVerify, verified), std::vector<std::string>());
}

TEST(HorizonContext, NeedsAnApron) {
  BuildOptions options;
  options.horizon_context = true;
  const Status checked = CheckOptions(options);
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.error().message.find("--apron N"), std::string::npos);
}

}  // namespace
}  // namespace farhorizon
