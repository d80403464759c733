// Whole comparisons: files of several formats against one DEM.
#include "core/pipeline/compare/compare.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/pipeline/build.h"
#include "core/pipeline/compare/comparison_json.h"
#include "core/pipeline/compare/comparison_text.h"
#include "core/pipeline/compare/level_summary.h"
#include "tests/support/json_schema.h"
#include "tests/support/placed_dem.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class CompareTest : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path Path(const std::string& name) const {
    return dem_.folder() / name;
  }
  Result<Comparison> Run(const std::string& name, const CompareOptions& options = {}) {
    return CompareMesh(dem_.path(), Path(name), options, dem_.options(), {});
  }
  Result<Comparison> RunOn(const std::string& name, const std::string& bytes,
                           const CompareOptions& options = {}) {
    SpillFile(Path(name), bytes);
    return Run(name, options);
  }
  // The one mesh of a comparison.
  MeshComparison Only(const Result<Comparison>& comparison) {
    if (!comparison) throw std::runtime_error(comparison.error().message);
    if (comparison->meshes.size() != 1) throw std::runtime_error("not one mesh");
    return comparison->meshes.front();
  }
  static void ExpectExact(const MeshComparison& mesh, double within_m) {
    EXPECT_EQ(mesh.fault, std::nullopt);
    EXPECT_LE(mesh.error.vertical.max_m, within_m);
    // Lines that graze the outline see what rounding leaves of it.
    EXPECT_LE(mesh.error.silhouette.rms_m, 0.1);
    EXPECT_LE(std::abs(mesh.mean_error_m), within_m);
    EXPECT_FALSE(mesh.IsUnsound());
    EXPECT_NEAR(mesh.correlation, 1, 1e-6);
  }

  PlacedDem dem_;
};

TEST_F(CompareTest, TheDemsOwnMeshIsExactInEveryFormatAndFrame) {
  const PlainMesh posts = dem_.InPosts();
  const PlainMesh tile = dem_.InTileFrame();
  ExpectExact(Only(RunOn("a.obj", ObjText(posts))), 1e-6);
  ExpectExact(Only(RunOn("a.ply", PlyBytes(posts, true))), 1e-6);
  ExpectExact(Only(RunOn("a.stl", StlBytes(posts))), 1e-6);
  ExpectExact(Only(RunOn("a.drc", DracoText(posts, true))), 1e-6);
  ExpectExact(Only(RunOn("ecef.ply", PlyText(dem_.InEcef()))), 1e-6);
  // Floats over 2 km.
  ExpectExact(Only(RunOn("tile.glb", GlbBytes(PlainGltf(YUp(tile))))), 1e-3);
  ExpectExact(Only(RunOn("draco.glb", GlbBytes(DracoGltf(YUp(tile))))), 1e-3);
  const MeshComparison mesh = Only(RunOn("meshopt.glb", GlbBytes(MeshoptGltf(YUp(posts)))));
  ExpectExact(mesh, 1e-6);
  EXPECT_EQ(mesh.posts, 600);
  EXPECT_EQ(mesh.covered_share, 1);
  EXPECT_FALSE(mesh.in_part);
  EXPECT_EQ(mesh.triangles, 2 * 29 * 19);
}

TEST_F(CompareTest, MeasuresWhatWasMoved) {
  PlainMesh mesh = dem_.InPosts();
  mesh.points[10 * PlacedDem::kColumns + 15][2] += 7;
  const MeshComparison raised = Only(RunOn("a.obj", ObjText(mesh)));
  EXPECT_NEAR(raised.error.vertical.max_m, 7, 1e-9);
  EXPECT_NEAR(raised.error.vertical.rms_m, 7 / std::sqrt(600), 1e-9);
  EXPECT_NEAR(raised.mean_error_m, 7.0 / 600, 1e-9);
  // A new summit within: some skylines rise by about as much.
  mesh.points[10 * PlacedDem::kColumns + 15][2] += 600;
  const MeshComparison summit = Only(RunOn("a.obj", ObjText(mesh)));
  EXPECT_GT(summit.error.silhouette.max_m, 100);
  EXPECT_LE(summit.error.silhouette.max_m, 1.1 * 607);
  EXPECT_GT(summit.error.silhouette.rms_m, raised.error.silhouette.rms_m);
}

TEST_F(CompareTest, ComparesAPartWithThatPartAndSaysSo) {
  PlainMesh mesh = dem_.InPosts();
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::ranges::any_of(
        t, [&](std::uint32_t v) { return mesh.points[v][0] > 17 || mesh.points[v][1] < 5; });
  });
  const auto comparison = RunOn("a.obj", ObjText(mesh), {.placing = {.frame = MeshFrame::kPosts}});
  const MeshComparison part = Only(comparison);
  ExpectExact(part, 1e-6);
  EXPECT_TRUE(part.in_part);
  EXPECT_EQ(part.posts, 18 * 15);
  EXPECT_NEAR(part.covered_share, 0.45, 1e-12);
  EXPECT_EQ(part.error.defects.open_edges, 0);
  EXPECT_THAT(ComparisonText(*comparison), HasSubstr("270 posts, 45.0 % of the DEM's"));
}

TEST_F(CompareTest, NamesEachDefect) {
  PlainMesh hole = dem_.InPosts();
  std::erase_if(hole.triangles, [&](const auto& t) {
    return std::ranges::any_of(t, [](std::uint32_t v) { return v == 8 * 30 + 12; });
  });
  const auto holed = RunOn("a.obj", ObjText(hole));
  EXPECT_EQ(Only(holed).hole_posts, 1);
  EXPECT_TRUE(Only(holed).IsUnsound());
  EXPECT_THAT(ComparisonText(*holed), HasSubstr("UNSOUND: holes"));

  PlainMesh flipped = dem_.InPosts();
  std::swap(flipped.triangles[100][0], flipped.triangles[100][1]);
  EXPECT_EQ(Only(RunOn("a.obj", ObjText(flipped))).error.defects.flipped, 1);

  PlainMesh twice = dem_.InPosts();
  twice.points.push_back({2.2, 2.2, 800});
  twice.points.push_back({2.2, 6.2, 800});
  twice.points.push_back({6.2, 6.2, 800});
  twice.triangles.push_back({600, 602, 601});
  const MeshComparison doubled =
      Only(RunOn("a.obj", ObjText(twice), {.placing = {.frame = MeshFrame::kPosts}}));
  EXPECT_GT(doubled.error.defects.covered_twice, 0);

  // Rows run down: what is counter-clockwise in (column, row) is clockwise from above.
  EXPECT_TRUE(Only(holed).turned);
  PlainMesh from_above = dem_.InPosts();
  for (auto& t : from_above.triangles) std::swap(t[0], t[1]);
  const MeshComparison sound = Only(RunOn("a.obj", ObjText(from_above)));
  EXPECT_FALSE(sound.turned);
  ExpectExact(sound, 1e-6);
}

TEST_F(CompareTest, LeavesSkirtsOut) {
  PlainMesh mesh = dem_.InTileFrame();
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (std::uint32_t c = 0; c < PlacedDem::kColumns; ++c) {
    mesh.points.push_back(mesh.points[c]);
    mesh.points.back()[2] -= 100;
  }
  for (std::uint32_t c = 0; c + 1 < PlacedDem::kColumns; ++c) {
    mesh.triangles.push_back({c, first + c, c + 1});
    mesh.triangles.push_back({c + 1, first + c, first + c + 1});
  }
  const MeshComparison skirted = Only(RunOn("a.glb", GlbBytes(PlainGltf(YUp(mesh)))));
  ExpectExact(skirted, 1e-3);
  EXPECT_EQ(skirted.skirt_triangles, 58);
}

TEST_F(CompareTest, RefusesHeightsAboveAnotherDatumUnlessTheyAreMoved) {
  PlainMesh mesh = dem_.InPosts();
  for (auto& p : mesh.points) p[2] += 48.5;
  const auto refused = RunOn("a.obj", ObjText(mesh));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, "mesh-elsewhere");
  EXPECT_THAT(refused.error().message, HasSubstr("48.5 m above"));
  ExpectExact(Only(Run("a.obj", {.placing = {.height_offset_m = -48.5}})), 1e-6);
}

TEST_F(CompareTest, MeasuresEveryContentOfATilesetThatCanBe) {
  SpillFile(Path("good.glb"), GlbBytes(PlainGltf(YUp(dem_.InTileFrame()))));
  SpillFile(Path("bad.glb"), "glTF");
  const auto transform = dem_.input().georeference().frame().EnuToEcef();
  const json tileset = {
      {"asset", {{"version", "1.1"}}},
      {"geometricError", 90},
      {"root",
       {{"transform", transform},
        {"geometricError", 40},
        {"content", {{"uri", "good.glb"}}},
        {"children", {{{"geometricError", 0}, {"content", {{"uri", "bad.glb"}}}}}}}}};
  const auto comparison = RunOn("tileset.json", tileset.dump(), {.picture = true});
  ASSERT_TRUE(comparison) << comparison.error().message;
  ASSERT_EQ(comparison->meshes.size(), 2U);
  ExpectExact(comparison->meshes[0], 1e-3);
  EXPECT_EQ(comparison->meshes[0].depth, 0);
  EXPECT_EQ(comparison->meshes[0].geometric_error_m, 40);
  EXPECT_THAT(comparison->meshes[0].placing, HasSubstr("earth-fixed"));
  EXPECT_THAT(comparison->meshes[1].fault.value_or(""), HasSubstr("bad.glb"));
  EXPECT_THAT(comparison->picture, testing::StartsWith("<svg "));
  EXPECT_THAT(comparison->picture, HasSubstr("towards 135 degrees"));
  EXPECT_THAT(comparison->picture, Not(HasSubstr("nan")));
  EXPECT_THAT(comparison->picture, Not(HasSubstr("inf")));
  EXPECT_FALSE(Run("tileset.json", {.tile = "bad.glb"}));
  EXPECT_EQ(Only(Run("tileset.json", {.tile = "good.glb"})).name, "good.glb");
  const auto none = Run("tileset.json", {.tile = "none.glb"});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, "no-such-file");

  const json shape = json::parse(
      SlurpFile(std::string(FARHORIZON_SOURCE_DIR) + "/proto/schemas/compare.schema.json"));
  EXPECT_THAT(SchemaOffences(json::parse(ComparisonJson(*comparison)), shape), IsEmpty());
}

TEST_F(CompareTest, TakesTheTilesOfADepthTogether) {
  const PlainMesh whole = dem_.InTileFrame();
  const PlainMesh posts = dem_.InPosts();
  json children = json::array();
  for (const bool west : {true, false}) {
    PlainMesh half = whole;
    std::erase_if(half.triangles, [&](const auto& t) {
      return std::ranges::any_of(t, [&](std::uint32_t v) {
        return west ? posts.points[v][0] > 12 : posts.points[v][0] < 12;
      });
    });
    // One vertex of the west is 3 m too high.
    if (west) half.points[5 * PlacedDem::kColumns + 5][2] += 3;
    const std::string name = west ? "west.glb" : "east.glb";
    SpillFile(Path(name), GlbBytes(PlainGltf(YUp(half))));
    children.push_back({{"geometricError", 0}, {"content", {{"uri", name}}}});
  }
  const json tileset = {{"asset", {{"version", "1.1"}}},
                        {"geometricError", 90},
                        {"root",
                         {{"transform", dem_.input().georeference().frame().EnuToEcef()},
                          {"geometricError", 40},
                          {"children", children}}}};
  const auto comparison = RunOn("tileset.json", tileset.dump());
  ASSERT_TRUE(comparison) << comparison.error().message;
  ASSERT_EQ(comparison->meshes.size(), 2U);
  for (const MeshComparison& tile : comparison->meshes) {
    EXPECT_EQ(tile.fault, std::nullopt);
    EXPECT_TRUE(tile.in_part);
    EXPECT_FALSE(tile.IsUnsound());
  }
  EXPECT_LE(comparison->meshes[1].error.vertical.max_m, 1e-3);
  const std::vector<LevelSummary> levels = SummarizeLevels(comparison->meshes);
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_EQ(levels[0].tiles, 2);
  EXPECT_EQ(levels[0].triangles, 2 * 29 * 19);
  EXPECT_NEAR(levels[0].vertical.max_m, 3, 1e-3);
  // Over 13 and 18 columns: the common one counts twice.
  EXPECT_NEAR(levels[0].vertical.rms_m, 3 / std::sqrt(31 * 20), 1e-3);
  EXPECT_THAT(ComparisonText(*comparison), HasSubstr("depth 0, 2 tiles"));
}

TEST_F(CompareTest, MeasuresWhatABuildReports) {
  BuildOptions options = dem_.options();
  options.levels = 2;
  const Status built = BuildArtifacts(dem_.path(), Path("out"), options, {});
  ASSERT_TRUE(built) << built.error().message;
  const json report = json::parse(SlurpFile(Path("out") / "report.json"));
  const auto tileset = Run("out/tileset.json");
  ASSERT_TRUE(tileset) << tileset.error().message;
  ASSERT_EQ(tileset->meshes.size(), report["levels"].size());
  for (std::size_t i = 0; i < tileset->meshes.size(); ++i) {
    const json& level = report["levels"][i];
    const std::string name = "lod" + std::to_string(i);
    const MeshComparison& of_tileset = tileset->meshes[tileset->meshes.size() - 1 - i];
    EXPECT_EQ(of_tileset.name, name + ".glb");
    for (const MeshComparison& mesh :
         {of_tileset, Only(Run("out/" + name + ".glb")), Only(Run("out/" + name + ".drc"))}) {
      EXPECT_FALSE(mesh.IsUnsound());
      EXPECT_EQ(mesh.triangles, level["triangles"]);
      // Reports are rounded up in the third digit.
      EXPECT_LE(mesh.error.vertical.max_m, 1.001 * level["vertical_error_m"]["max"].get<double>());
      EXPECT_LE(mesh.error.vertical.rms_m, 1.001 * level["vertical_error_m"]["rms"].get<double>());
      EXPECT_LE(mesh.error.silhouette.rms_m,
                1.001 * level["silhouette_error_m"]["rms"].get<double>() + 1e-3);
    }
  }
}

}  // namespace
}  // namespace farhorizon
