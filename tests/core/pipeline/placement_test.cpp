// Random rasters of many reference systems are placed on the globe where GDAL's own program,
// gdaltransform, places their posts.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/terrain_input.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {
namespace {

using Position = std::array<double, 3>;

// The positions that gdaltransform makes of `points`, in traditional order: x or longitude first.
std::vector<Position> TransformedByGdal(const std::string& from, const std::string& to,
                                        const std::vector<Position>& points) {
  const TempDir folder;
  std::ofstream in(folder / "in");
  in.precision(17);
  for (const auto& [x, y, z] : points) in << x << " " << y << " " << z << "\n";
  in.close();
  const std::string command = "gdaltransform -s_srs '" + from + "' -t_srs '" + to + "' <'" +
                              (folder / "in").string() + "' >'" + (folder / "out").string() + "'";
  if (std::system(command.c_str()) != 0) throw std::runtime_error(command);
  std::istringstream out(SlurpFile(folder / "out"));
  std::vector<Position> result;
  for (Position p; out >> p[0] >> p[1] >> p[2];) result.push_back(p);
  if (result.size() != points.size()) throw std::runtime_error("gdaltransform lost points");
  return result;
}

// A reference system, a box of longitudes and latitudes where it is used, and the size of cells in
// its unit. A system without heights leaves those of the raster as they are, and they take no part
// in a datum shift.
struct System {
  std::string crs;
  std::array<double, 4> west_south_east_north;
  double cell;
  bool has_heights = false;
};

void PrintTo(const System& system, std::ostream* out) { *out << system.crs; }

class Placement : public ::testing::TestWithParam<System> {};

TEST_P(Placement, IsThatOfGdaltransform) {
  if (std::system("command -v gdaltransform >/dev/null") != 0) {
    GTEST_SKIP() << "no gdaltransform: Debian's gdal-bin has it";
  }
  const System& system = GetParam();
  const std::string globe = system.has_heights ? "EPSG:4979" : "EPSG:4326";
  std::mt19937 random(7);
  const auto [west, south, east, north] = system.west_south_east_north;
  std::uniform_real_distribution<double> longitude(west, east);
  std::uniform_real_distribution<double> latitude(south, north);
  std::vector<Position> places;
  for (int i = 0; i < 10; ++i) places.push_back({longitude(random), latitude(random), 0});
  for (const Position& origin : TransformedByGdal(globe, system.crs, places)) {
    TestRaster raster;
    raster.columns = 11;
    raster.rows = 8;
    raster.crs = system.crs;
    raster.type = "Float64";
    raster.values.clear();
    raster.geotransform = {origin[0], system.cell, 0, origin[1], 0, -system.cell};
    std::uniform_int_distribution<int> height(0, 3000);
    for (int i = 0; i < 11 * 8; ++i) raster.values.push_back(height(random));
    const TempDir folder;
    WriteTiff(folder / "dem.tif", raster);
    BuildOptions options;
    options.height_unit = "m";
    const auto input = TerrainInput::Open(folder / "dem.tif", options, {});
    ASSERT_TRUE(input) << input.error().message;
    std::vector<VertexId> posts;
    std::vector<Position> map;
    for (VertexId v = 0; v < 11 * 8; ++v) {
      posts.push_back(v);
      map.push_back({origin[0] + (v % 11 + 0.5) * system.cell,
                     origin[1] - (v / 11 + 0.5) * system.cell,
                     system.has_heights ? raster.values[v] : 0});
    }
    const auto placed = (*input)->georeference().ToGeodetic(posts);
    ASSERT_TRUE(placed) << placed.error().message;
    const std::vector<Position> expected = TransformedByGdal(system.crs, globe, map);
    for (std::size_t i = 0; i < posts.size(); ++i) {
      // A millimetre on the ground.
      ASSERT_NEAR(std::remainder((*placed)[i].lon_deg - expected[i][0], 360), 0, 1e-8);
      ASSERT_NEAR((*placed)[i].lat_deg, expected[i][1], 1e-8);
      const double metres = system.has_heights ? expected[i][2] : raster.values[i];
      ASSERT_NEAR((*placed)[i].height_m, metres, 1e-4);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Systems, Placement,
                         ::testing::Values(System{"EPSG:4326", {-170, -60, 170, 70}, 0.001},
                                           System{
                                               "EPSG:4326+5773", {-170, -60, 170, 70}, 0.001, true},
                                           System{"EPSG:32613", {-108, 5, -102, 70}, 30},
                                           System{"EPSG:32733+5773", {12, -70, 18, -5}, 30, true},
                                           System{"EPSG:3857", {-170, -60, 170, 70}, 50},
                                           System{"EPSG:3031", {-180, -85, 180, -70}, 200},
                                           System{"EPSG:3413", {-180, 65, 180, 85}, 200},
                                           System{"EPSG:25832", {6, 45, 12, 65}, 10},
                                           System{"EPSG:2193", {168, -46, 178, -36}, 25},
                                           System{"EPSG:2154", {-3, 43, 7, 50}, 25},
                                           System{"EPSG:2263", {-74.2, 40.5, -72.0, 41.2}, 100},
                                           System{"EPSG:2053", {28, -33, 30, -23}, 30},
                                           System{"EPSG:27700", {-5, 51, 1, 57}, 25},
                                           System{"EPSG:4807", {-3, 43, 7, 50}, 0.001}));

}  // namespace
}  // namespace farhorizon
