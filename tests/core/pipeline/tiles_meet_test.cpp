// Tiles that are cut from one DEM and made apart: what their common sides decode to on the globe.
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/pipeline/build.h"
#include "core/pipeline/level_artifact.h"
#include "core/pipeline/level_plan.h"
#include "core/pipeline/post_places.h"
#include "core/pipeline/report.h"
#include "core/pipeline/skirt.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/verify/verify.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {
namespace {

// Posts of the whole DEM, [column, row].
using Post = std::array<int, 2>;

// A level as decoded: where its vertices are on the globe and how they are lit, in earth-fixed
// axes, by post of the whole DEM.
struct DecodedLevel {
  LevelReport report;
  std::map<Post, Ecef> places;
  std::map<Post, Ecef> normals;
};

Ecef Transformed(const std::array<double, 16>& m, const Enu& p) {
  return {m[0] * p.east + m[4] * p.north + m[8] * p.up + m[12],
          m[1] * p.east + m[5] * p.north + m[9] * p.up + m[13],
          m[2] * p.east + m[6] * p.north + m[10] * p.up + m[14]};
}

double Distance(const Ecef& a, const Ecef& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

// A map whose posts are `step` apart from (x, y) on.
struct Map {
  std::string crs;
  double x = 0;
  double y = 0;
  double step = 0;
  std::string place;  // of --frame, half a degree and more off
};

const Map kDegrees = {"EPSG:4326", 7.25, 46.5, 1.0 / 3600, "6.5,46"};
const Map kUtm = {"EPSG:32632", 400000, 5100000, 30, "9,45.5"};

// The vertices of a mesh whose first post is `first` of the whole DEM.
DecodedLevel Decoded(const LocalMesh& mesh, const TangentFrame& frame, int columns,
                     const Post& first) {
  const std::array<double, 16> place = frame.EnuToEcef();
  std::array<double, 16> turn = place;
  turn[12] = turn[13] = turn[14] = 0;
  DecodedLevel decoded;
  for (std::size_t i = 0; i < mesh.posts.size(); ++i) {
    const auto post = static_cast<int>(mesh.posts[i]);
    const Post at = {first[0] + post % columns, first[1] + post / columns};
    const UnitNormal& normal = mesh.normals[i];
    decoded.places[at] = Transformed(place, mesh.positions[i]);
    decoded.normals[at] = Transformed(turn, {normal[0], normal[1], normal[2]});
  }
  return decoded;
}

enum class Measures { kLeftOut, kTaken };

// A DEM that tiles are cut from.
class CutDem {
 public:
  explicit CutDem(const Map& map) : map_(map) {}

  static double Height(int c, int r) {
    return std::round(900 + 160 * std::sin(c / 6.0 + r / 11.0) + 90 * std::cos(r / 4.0) + 3 * c);
  }

  // The levels of the tile of these columns and rows, first and last, its apron around them.
  std::vector<DecodedLevel> Tile(const std::array<int, 2>& columns, const std::array<int, 2>& rows,
                                 BuildOptions options, Measures measures = Measures::kLeftOut) {
    TestRaster raster;
    const int west = columns[0] - options.apron;
    const int north = rows[0] - options.apron;
    raster.columns = columns[1] + options.apron - west + 1;
    raster.rows = rows[1] + options.apron - north + 1;
    raster.values.clear();
    for (int r = 0; r < raster.rows; ++r) {
      for (int c = 0; c < raster.columns; ++c) raster.values.push_back(Height(west + c, north + r));
    }
    raster.crs = map_.crs;
    raster.geotransform = {{map_.x + (west - 0.5) * map_.step, map_.step, 0,
                            map_.y - (north - 0.5) * map_.step, 0, -map_.step}};
    WriteTiff(folder_ / "tile.tif", raster);
    options.vertical_datum = "ellipsoid";
    options.height_unit = "m";
    const auto input = *TerrainInput::Open(folder_ / "tile.tif", options, {});
    const Terrain& terrain = input->terrain();
    const Georeference& georeference = input->georeference();
    const LevelPlan plan = *PlanLevels(*input, options);
    const Horizon horizon = *FindHorizon(terrain, {}, {});
    const std::vector<Lod> chain = *BuildLodChain(terrain, horizon, plan.lods, {});
    const PostNormals normals = *FindPostNormals(input->around(), georeference, input->apron());
    MeshMeasurer measurer(terrain, horizon, *FindPostPlaces(terrain, georeference));
    const RunControl control;
    const LevelContext context{terrain, horizon, georeference, normals, measurer, control};
    std::vector<DecodedLevel> levels;
    std::vector<LevelReport> reports;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const LevelStorage storage = {plan.finest_side_m, CoarsenessOf(plan, terrain.dem(), i), 0,
                                    false, true};
      LevelArtifact level = *EncodeLevel(context, chain[i], static_cast<int>(i), storage);
      if (measures == Measures::kTaken) {
        ReportErrors(*measurer.Measure(*PlaceLevel(context, level.decoded.mesh), control),
                     level.report);
      }
      reports.push_back(level.report);
      levels.push_back(Decoded(level.decoded.mesh, georeference.frame(), terrain.dem().columns,
                               {columns[0], rows[0]}));
    }
    const std::vector<double> depths = SkirtDepths(*input, reports, std::nullopt);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      levels[i].report = reports[i];
      levels[i].report.skirt_m = depths[i];
    }
    return levels;
  }

 private:
  Map map_;
  TempDir folder_;
};

// The distances on the globe of posts that both have; `on_side` says which posts are shared.
struct Shared {
  std::size_t posts = 0;
  std::size_t of_one = 0;  // posts on the side that only one has
  double greatest_m = 0;
};
template <typename OnSide>
Shared CompareTiles(const DecodedLevel& a, const DecodedLevel& b, OnSide on_side) {
  Shared shared;
  for (const auto& [post, place] : a.places) {
    if (!on_side(post)) continue;
    const auto other = b.places.find(post);
    if (other == b.places.end()) {
      ++shared.of_one;
      continue;
    }
    ++shared.posts;
    shared.greatest_m = std::max(shared.greatest_m, Distance(place, other->second));
  }
  for (const auto& [post, place] : b.places) {
    if (on_side(post) && !a.places.contains(post)) ++shared.of_one;
  }
  return shared;
}

struct FrameCase {
  const char* name;
  const Map* map;
  bool globe;
};

class TilesMeet : public testing::TestWithParam<FrameCase> {};

// Cut in four at column 21 and row 16, of unlike widths and heights.
TEST_P(TilesMeet, PostsOfACommonSideAreEqualInOneFrame) {
  CutDem dem(*GetParam().map);
  BuildOptions options;
  options.levels = 1;
  options.frame = *FrameFromText(GetParam().globe ? "globe" : GetParam().map->place);
  std::vector<DecodedLevel> tiles;
  for (const std::array<int, 2>& rows : {std::array{0, 16}, std::array{16, 40}}) {
    for (const std::array<int, 2>& columns : {std::array{0, 21}, std::array{21, 33}}) {
      tiles.push_back(dem.Tile(columns, rows, options).front());
    }
  }
  for (const auto& [i, j] : {std::pair(0, 1), {2, 3}, {0, 2}, {1, 3}}) {
    const auto& a = tiles[static_cast<std::size_t>(i)];
    const auto& b = tiles[static_cast<std::size_t>(j)];
    const bool upright = j == i + 1;
    const Shared shared =
        CompareTiles(a, b, [&](const Post& p) { return upright ? p[0] == 21 : p[1] == 16; });
    EXPECT_GE(shared.posts, 6U);
    EXPECT_EQ(shared.of_one, 0U);
    EXPECT_LT(shared.greatest_m, 1e-6) << i << " and " << j;
  }
}

INSTANTIATE_TEST_SUITE_P(Frames, TilesMeet,
                         testing::Values(FrameCase{"PlaceOfDegrees", &kDegrees, false},
                                         FrameCase{"GlobeOfDegrees", &kDegrees, true},
                                         FrameCase{"PlaceOfMetres", &kUtm, false},
                                         FrameCase{"GlobeOfMetres", &kUtm, true}),
                         [](const auto& one) { return one.param.name; });

TEST(TilesMeetOfTheirOwnFrames, PostsOfACommonSideAreWithinAStep) {
  CutDem dem(kDegrees);
  BuildOptions options;
  options.levels = 1;
  const DecodedLevel west = dem.Tile({0, 21}, {0, 30}, options).front();
  const DecodedLevel east = dem.Tile({21, 33}, {0, 30}, options).front();
  const Shared shared = CompareTiles(west, east, [](const Post& p) { return p[0] == 21; });
  EXPECT_GE(shared.posts, 6U);
  EXPECT_EQ(shared.of_one, 0U);
  EXPECT_GT(shared.greatest_m, 0);
  // Half a step on each of three axes, in each tile.
  EXPECT_LT(shared.greatest_m, std::sqrt(3) * west.report.side_step_m);
}

// The greatest angle between the normals of two tiles on their common side, degrees.
double GreatestTurn(const DecodedLevel& west, const DecodedLevel& east, int column) {
  double chord = 0;
  for (const auto& [post, normal] : west.normals) {
    if (post[0] != column || !east.normals.contains(post)) continue;
    chord = std::max(chord, Distance(normal, east.normals.at(post)));
  }
  return 2 * std::asin(chord / 2) * 180 / std::acos(-1.0);
}

TEST(TilesMeetLit, NormalsOfACommonSideAreEqualWithAnApron) {
  CutDem dem(kDegrees);
  BuildOptions options;
  options.triangles = {250, 60};
  struct Case {
    const char* frame;
    int apron;
  };
  for (const auto& [frame, apron] :
       {Case{"globe", 0}, Case{"globe", 1}, Case{"globe", 4}, Case{"tile", 4}}) {
    options.frame = *FrameFromText(frame);
    options.apron = apron;
    const std::vector<DecodedLevel> west = dem.Tile({0, 20}, {0, 20}, options);
    const std::vector<DecodedLevel> east = dem.Tile({20, 40}, {0, 20}, options);
    for (const std::size_t level : {0U, 1U}) {
      const double turn = GreatestTurn(west[level], east[level], 20);
      if (apron == 0) {
        EXPECT_GT(turn, 3) << frame << level;
      } else {
        // Rounded along other axes, each by less than a degree; in one frame, alike.
        EXPECT_LT(turn, options.frame == FrameChoice{} ? 2 : 1e-6) << frame << level;
      }
    }
    EXPECT_EQ(west[0].report.seam_reach, std::min(std::max(apron - 1, 0), 1));
  }
}

TEST(TilesMeetLit, TheApronIsNotMeshedAndVerifies) {
  const TempDir folder;
  TestRaster raster{.columns = 17, .rows = 16, .values = {}};
  for (int r = 0; r < raster.rows; ++r) {
    for (int c = 0; c < raster.columns; ++c) raster.values.push_back(CutDem::Height(c, r));
  }
  WriteTiff(folder / "dem.tif", raster);
  BuildOptions options;
  options.apron = 3;
  options.frame = *FrameFromText("-123,46");
  ASSERT_TRUE(BuildArtifacts(folder / "dem.tif", folder / "out", options, {}));
  const Report report = *ReadReport(SlurpFile(folder / "out" / "report.json"));
  EXPECT_EQ(report.dem.columns, 11);
  EXPECT_EQ(report.dem.rows, 10);
  EXPECT_EQ(report.dem.apron, 3);
  const auto claims = *VerifyArtifacts(folder / "dem.tif", folder / "out", {}, {});
  for (const ClaimCheck& check : claims) EXPECT_TRUE(check.holds) << check.claim;
  options.apron = 8;
  const Status none = BuildArtifacts(folder / "dem.tif", folder / "out", options, {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, "invalid-parameter");
}

// Level 1 of the west beside level 0 of the east, and the other way round.
TEST(TilesMeetAtOtherLevels, GapsAreWithinTheErrorsAndTheSkirts) {
  CutDem dem(kUtm);
  BuildOptions options;
  options.triangles = {700, 150};
  options.frame = *FrameFromText("globe");
  const std::vector<DecodedLevel> west = dem.Tile({0, 32}, {0, 32}, options, Measures::kTaken);
  const std::vector<DecodedLevel> east = dem.Tile({32, 64}, {0, 32}, options, Measures::kTaken);
  // The height of a level's side over each row, above the centre of the Earth.
  const auto side = [](const DecodedLevel& level) {
    std::vector<double> heights;
    std::optional<std::pair<int, double>> last;
    for (const auto& [post, p] : level.places) {  // by column, then row
      if (post[0] != 32) continue;
      const double height = std::hypot(p.x, p.y, p.z);
      for (int r = last ? last->first + 1 : post[1]; r <= post[1]; ++r) {
        const double share = last ? double(r - last->first) / (post[1] - last->first) : 1;
        heights.push_back(last ? last->second + share * (height - last->second) : height);
      }
      last = {post[1], height};
    }
    return heights;
  };
  for (const auto& [fine, coarse] : {std::pair(west[0], east[1]), std::pair(east[0], west[1])}) {
    const std::vector<double> a = side(fine);
    const std::vector<double> b = side(coarse);
    ASSERT_EQ(a.size(), 33U);
    ASSERT_EQ(b.size(), 33U);
    double gap_m = 0;
    for (std::size_t r = 0; r < a.size(); ++r) gap_m = std::max(gap_m, std::abs(a[r] - b[r]));
    EXPECT_GT(gap_m, 0);
    EXPECT_LE(gap_m, fine.report.geometric_error_m + coarse.report.geometric_error_m);
    EXPECT_LE(gap_m, fine.report.skirt_m);
    EXPECT_LE(gap_m, coarse.report.skirt_m);
  }
  for (const std::size_t level : {0U, 1U}) {
    const Shared shared =
        CompareTiles(west[level], east[level], [](const Post& p) { return p[0] == 32; });
    EXPECT_GE(shared.posts, 3U);
    EXPECT_EQ(shared.of_one, 0U);
    EXPECT_LT(shared.greatest_m, 1e-6);
  }
}

}  // namespace
}  // namespace farhorizon
