// The tiles of whole builds, read by the specification: they cover the globe's rectangles, meet,
// and show the DEM as well as they say.
#include "core/pipeline/terrain_tiles/terrain_tiles.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/quantized_mesh/layer_json.h"
#include "core/pipeline/build.h"
#include "core/pipeline/report.h"
#include "tests/support/gunzip.h"
#include "tests/support/temp_dir.h"
#include "tests/support/terrain_tile.h"
#include "tests/support/test_raster.h"

namespace farhorizon {
namespace {

constexpr int kColumns = 26;
constexpr int kRows = 22;
constexpr double kStep = 0.001;
constexpr double kNoData = -32768;

double Hills(int c, int r) {
  return std::round(700 + 90 * std::sin(c / 3.0 + r / 7.0) + 60 * std::cos(r / 2.5));
}

// A DEM of degrees from `west` and `north` on, and the tiles of its build.
class BuiltTiles {
 public:
  explicit BuiltTiles(double west, double north, const std::vector<double>& heights,
                      int threads = 1)
      : west_(west), north_(north), heights_(heights) {
    TestRaster raster;
    raster.columns = kColumns;
    raster.rows = kRows;
    raster.values = heights;
    raster.crs = "EPSG:4326";
    raster.nodata = kNoData;
    raster.geotransform = {{west - kStep / 2, kStep, 0, north + kStep / 2, 0, -kStep}};
    WriteTiff(folder_ / "dem.tif", raster);
    BuildOptions options;
    options.formats = {"quantized-mesh"};
    options.vertical_datum = "ellipsoid";
    options.height_unit = "m";
    options.triangles = {400, 200};
    options.threads = threads;
    status_ = BuildArtifacts(folder_ / "dem.tif", folder_ / "out", options, {});
    if (!status_) return;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out")) {
      const std::string name = entry.path().filename();
      files_[name] = SlurpFile(entry.path());
      TileAddress at;
      if (std::sscanf(name.c_str(), "terrain-%d-%ld-%ld.terrain", &at.zoom, &at.x, &at.y) == 3) {
        tiles_[at] = ReadTerrainTile(Gunzip(files_[name]));
      }
    }
    layer_ = nlohmann::json::parse(files_.at("layer.json"));
  }

  // The height of the deepest tiles over a post, as a client finds it; nullopt where none is.
  [[nodiscard]] std::optional<double> HeightAt(double column, double row) const {
    const int zoom = layer_.at("maxzoom");
    const double side = std::ldexp(180, -zoom);
    const double lon = std::remainder(west_ + kStep * column, 360) + 180;
    const double lat = north_ - kStep * row + 90;
    const TileAddress at = {zoom, static_cast<std::int64_t>(lon / side),
                            static_cast<std::int64_t>(lat / side)};
    const auto found = tiles_.find(at);
    if (found == tiles_.end()) return std::nullopt;
    const TerrainTile& tile = found->second;
    const double u = (lon / side - static_cast<double>(at.x)) * 32767;
    const double v = (lat / side - static_cast<double>(at.y)) * 32767;
    std::optional<double> highest;
    for (const auto& t : tile.triangles) {
      const auto& a = tile.vertices[t[0]];
      const auto& b = tile.vertices[t[1]];
      const auto& c = tile.vertices[t[2]];
      const auto cross = [&](const auto& p, const auto& q) {
        return (q[0] - p[0]) * (v - p[1]) - (q[1] - p[1]) * (u - p[0]);
      };
      const double wa = cross(b, c);
      const double wb = cross(c, a);
      const double wc = cross(a, b);
      if (wa < 0 || wb < 0 || wc < 0 || wa + wb + wc == 0) continue;
      const double height =
          (wa * tile.HeightM(t[0]) + wb * tile.HeightM(t[1]) + wc * tile.HeightM(t[2])) /
          (wa + wb + wc);
      highest = std::max(height, highest.value_or(height));
    }
    return highest;
  }

  [[nodiscard]] double Height(int column, int row) const {
    return heights_[static_cast<std::size_t>(row * kColumns + column)];
  }

  // True where all posts around this one have data: its own place is well within the ground.
  [[nodiscard]] bool IsInside(int column, int row) const {
    if (column < 1 || row < 1 || column + 1 >= kColumns || row + 1 >= kRows) return false;
    for (int r = row - 1; r <= row + 1; ++r) {
      for (int c = column - 1; c <= column + 1; ++c) {
        if (Height(c, r) == kNoData) return false;
      }
    }
    return true;
  }

  // What the deepest tiles with ground say that they are off.
  [[nodiscard]] double DeepestError() const {
    double error = 0;
    for (const auto& [at, tile] : tiles_) {
      if (at.zoom == layer_.at("maxzoom")) {
        error = std::max(error, tile.metadata.at("geometricerror").get<double>());
      }
    }
    return error;
  }

  TempDir folder_;
  double west_;
  double north_;
  std::vector<double> heights_;
  Status status_ = Ok{};
  std::map<std::string, std::string> files_;
  std::map<TileAddress, TerrainTile> tiles_;
  nlohmann::json layer_;
};

std::vector<double> HillsWithVoids() {
  std::vector<double> heights;
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kColumns; ++c) {
      const bool hole = r >= 8 && r < 12 && c >= 9 && c < 14;
      const bool bay = r > 15 && c > 19;
      heights.push_back(hole || bay ? kNoData : Hills(c, r));
    }
  }
  return heights;
}

// On no side of a tile; over the meridian of 180 degrees; with sides of tiles for its own.
constexpr std::array<std::array<double, 2>, 3> kPlaces = {
    {{7.123, 46.321}, {179.9871, -17.2}, {0, 45}}};

class TerrainTiles : public ::testing::TestWithParam<std::size_t> {
 protected:
  // Each place is built once.
  static const BuiltTiles& At(std::size_t place) {
    static std::array<std::unique_ptr<BuiltTiles>, kPlaces.size()> built;
    if (!built[place]) {
      built[place] =
          std::make_unique<BuiltTiles>(kPlaces[place][0], kPlaces[place][1], HillsWithVoids());
    }
    return *built[place];
  }
  void SetUp() override { ASSERT_TRUE(built_.status_); }
  const BuiltTiles& built_ = At(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Places, TerrainTiles, ::testing::Range<std::size_t>(0, kPlaces.size()));

TEST_P(TerrainTiles, CoverTheirRectanglesOnce) {
  for (const auto& [at, tile] : built_.tiles_) {
    std::int64_t area = 0;
    for (const auto& t : tile.triangles) {
      const auto& a = tile.vertices[t[0]];
      const auto& b = tile.vertices[t[1]];
      const auto& c = tile.vertices[t[2]];
      area += std::int64_t{b[0] - a[0]} * (c[1] - a[1]) - std::int64_t{b[1] - a[1]} * (c[0] - a[0]);
    }
    EXPECT_EQ(area, std::int64_t{2} * 32767 * 32767) << TileName(at);
  }
}

TEST_P(TerrainTiles, AreThereDownFromBothOfZoom0AndListed) {
  std::set<TileAddress> listed;
  int zoom = 0;
  for (const auto& rectangles : built_.layer_["available"]) {
    for (const auto& one : rectangles) {
      for (std::int64_t x = one["startX"]; x <= one["endX"].get<std::int64_t>(); ++x) {
        for (std::int64_t y = one["startY"]; y <= one["endY"].get<std::int64_t>(); ++y) {
          listed.insert({zoom, x, y});
        }
      }
    }
    ++zoom;
  }
  EXPECT_EQ(listed.size(), built_.tiles_.size());
  for (const auto& [at, tile] : built_.tiles_) {
    EXPECT_TRUE(listed.contains(at)) << TileName(at);
    if (at.zoom > 0) {
      EXPECT_TRUE(built_.tiles_.contains({at.zoom - 1, at.x / 2, at.y / 2})) << TileName(at);
    }
  }
  EXPECT_TRUE(built_.tiles_.contains({0, 0, 0}));
  EXPECT_TRUE(built_.tiles_.contains({0, 1, 0}));
}

// The vertices of a side: along it, and up, in thousandths of a millimetre.
std::set<std::array<std::int64_t, 2>> Side(const TerrainTile& tile, std::size_t side) {
  std::set<std::array<std::int64_t, 2>> places;
  for (const std::uint32_t v : tile.sides[side]) {
    places.insert({tile.vertices[v][side % 2 == 0 ? 1 : 0], std::llround(tile.HeightM(v) * 1e6)});
  }
  return places;
}

TEST_P(TerrainTiles, MeetOnTheirSides) {
  int shared = 0;
  for (const auto& [at, tile] : built_.tiles_) {
    const std::int64_t columns = std::int64_t{2} << at.zoom;
    const auto east = built_.tiles_.find({at.zoom, (at.x + 1) % columns, at.y});
    const auto north = built_.tiles_.find({at.zoom, at.x, at.y + 1});
    if (east != built_.tiles_.end()) {
      EXPECT_EQ(Side(tile, 2), Side(east->second, 0)) << TileName(at);
      ++shared;
    }
    if (north != built_.tiles_.end()) {
      EXPECT_EQ(Side(tile, 3), Side(north->second, 1)) << TileName(at);
      ++shared;
    }
  }
  EXPECT_GT(shared, 4);
}

TEST_P(TerrainTiles, ListEachVertexThatIsOnASide) {
  for (const auto& [at, tile] : built_.tiles_) {
    for (std::size_t side = 0; side < 4; ++side) {
      const std::set<std::uint32_t> listed(tile.sides[side].begin(), tile.sides[side].end());
      for (std::uint32_t v = 0; v < tile.vertices.size(); ++v) {
        const bool is_on = tile.vertices[v][side % 2] == (side < 2 ? 0 : 32767);
        EXPECT_EQ(listed.contains(v), is_on) << TileName(at);
      }
    }
  }
}

TEST_P(TerrainTiles, ShowThePostsAsWellAsTheySay) {
  const double error = built_.DeepestError();
  EXPECT_LT(error, 60);
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kColumns; ++c) {
      if (!built_.IsInside(c, r)) continue;
      const std::optional<double> shown = built_.HeightAt(c, r);
      ASSERT_TRUE(shown) << c << ", " << r;
      EXPECT_NEAR(*shown, built_.Height(c, r), error) << c << ", " << r;
    }
  }
}

// Along the parallels of posts the skyline's height is that of a post.
TEST_P(TerrainTiles, ShowTheSkylineOfLevel0) {
  const Result<Report> report = ReadReport(built_.files_.at("report.json"));
  ASSERT_TRUE(report);
  // What places and heights lose by being rounded, beside the level's own error.
  const double allowed = report->levels[0].silhouette.max_m + built_.DeepestError() -
                         report->levels[0].geometric_error_m;
  for (int r = 1; r + 1 < kRows; ++r) {
    double is = 0;
    double shown = 0;
    for (int c = 1; c + 1 < kColumns; ++c) {
      is = std::max(is, built_.Height(c, r));
      for (const double beside : {0.0, 0.25, 0.5, 0.75}) {
        shown = std::max(shown, built_.HeightAt(c + beside, r).value_or(0));
      }
    }
    // A sample may miss the top of the mesh's line, and the outermost columns are left out of both.
    EXPECT_NEAR(shown, is, allowed + 1) << r;
  }
}

TEST_P(TerrainTiles, ShowTheEllipsoidBesideTheDem) {
  // Two hundredths of a cell beside it, the tile is the DEM's; there may be none further away.
  const std::optional<double> beside = built_.HeightAt(kColumns - 1 + 0.05, 5);
  if (beside) {
    EXPECT_NEAR(*beside, 0, 0.01);
  }
  // A hole is closed from side to side.
  const std::optional<double> hole = built_.HeightAt(11, 10);
  ASSERT_TRUE(hole);
  EXPECT_NEAR(*hole, 700, 160);
}

TEST(TerrainTilesOfABuild, AreTheSameAtAnyNumberOfThreads) {
  const BuiltTiles one(7.123, 46.321, HillsWithVoids(), 1);
  const BuiltTiles three(7.123, 46.321, HillsWithVoids(), 3);
  ASSERT_TRUE(one.status_);
  EXPECT_EQ(one.files_, three.files_);
}

TEST(TerrainTilesOfABuild, GroundBelowTheEllipsoidIsAPit) {
  std::vector<double> heights;
  for (int i = 0; i < kColumns * kRows; ++i) heights.push_back(-90 - 40 * (i % kColumns % 3));
  const BuiltTiles built(-97.3, 32.7, heights);
  ASSERT_TRUE(built.status_) << built.status_.error().message;
  const std::optional<double> ground = built.HeightAt(12, 12);
  ASSERT_TRUE(ground);
  EXPECT_NEAR(*ground, -130, 45);
}

TEST(TerrainTilesOfABuild, RefusesAPole) {
  std::vector<double> heights;
  for (int i = 0; i < kColumns * kRows; ++i) heights.push_back(100 + i % 7);
  TestRaster raster;
  raster.columns = kColumns;
  raster.rows = kRows;
  raster.values = heights;
  raster.crs = "EPSG:3413";  // polar stereographic
  raster.geotransform = {{-1300, 100, 0, 1100, 0, -100}};
  TempDir folder;
  WriteTiff(folder / "dem.tif", raster);
  BuildOptions options;
  options.formats = {"quantized-mesh"};
  const Status built = BuildArtifacts(folder / "dem.tif", folder / "out", options, {});
  ASSERT_FALSE(built);
  EXPECT_EQ(built.error().kind, "too-large-extent");
  EXPECT_THAT(built.error().message, ::testing::HasSubstr("--formats"));
  options.formats = {"3dtiles"};
  EXPECT_TRUE(BuildArtifacts(folder / "dem.tif", folder / "out", options, {}));
}

}  // namespace
}  // namespace farhorizon
