// The page as a build leaves it, for ground of every kind.
#include "core/pipeline/report_page/report_page.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/pipeline/build.h"
#include "core/pipeline/report_page/map_section.h"
#include "tests/support/html_checks.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class Page : public ::testing::Test {
 protected:
  std::string Built(const TestRaster& raster, BuildOptions options = {},
                    const RunControl& control = {}) {
    WriteTiff(folder_ / "dem.tif", raster);
    Status built = BuildArtifacts(folder_ / "dem.tif", folder_ / "out", options, control);
    EXPECT_TRUE(built) << built.error().message;
    return SlurpFile(folder_ / "out" / "report.html");
  }
  // Built, and sound.
  std::string Sound(const TestRaster& raster, const BuildOptions& options = {}) {
    std::string page = Built(raster, options);
    EXPECT_THAT(HtmlOffences::Of(page), IsEmpty());
    EXPECT_EQ(Count(page, "http:"), 0U);
    EXPECT_EQ(Count(page, "https:"), 0U);
    EXPECT_EQ(Count(page, ">nan"), 0U);
    EXPECT_LT(page.size(), 2'000'000U);
    return page;
  }
  static std::size_t Count(const std::string& page, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = page.find(what, at)) != std::string::npos; ++at) ++count;
    return count;
  }

  TempDir folder_;
};

TestRaster Hills(int columns, int rows) {
  TestRaster raster{.columns = columns, .rows = rows, .values = {}};
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      raster.values.push_back(std::round(500 + 60 * std::sin(c / 3.0) + 40 * std::cos(r / 2.5)));
    }
  }
  return raster;
}

TEST_F(Page, ShowsTheDemAndEveryLevel) {
  const std::string page = Sound(Hills(60, 50));
  const std::string report = SlurpFile(folder_ / "out" / "report.json");
  const std::size_t levels = Count(report, "\"geometric_error_m\"");
  ASSERT_GE(levels, 1U);
  EXPECT_EQ(Count(page, "<figure data-shows="), levels + 1);
  EXPECT_EQ(Count(page, "data:image/jpeg;base64,"), levels + 1);
  EXPECT_GE(Count(page, "data:image/png;base64,"), 4U);
  for (const char* looking : {"north", "east", "south", "west", "north-east", "south-west"}) {
    EXPECT_GE(Count(page, std::string("Looking ") + looking + "<"), 1U);
  }
  EXPECT_THAT(SlurpFile(folder_ / "out" / "manifest.json"), HasSubstr("report.html"));
}

TEST_F(Page, SaysWhichSkylinesOnTheOutlineItCounts) {
  const std::string page = Sound(Hills(20, 20));
  EXPECT_EQ(Count(page, "where it is not on the terrain"), 1U) << "the bound of the summary";
  EXPECT_EQ(Count(page, "with a skyline on the outline included"), 2U) << "both tables";
}

TEST_F(Page, IsTheSameEachTimeAndHasTimesOnlyWhereAsked) {
  BuildOptions options;
  options.levels = 2;
  const std::string page = Built(Hills(20, 20), options);
  options.threads = 3;
  EXPECT_EQ(Built(Hills(20, 20), options), page);
  EXPECT_GE(Count(page, "--timings"), 1U);
  RunControl control;
  control.timings = [] { return StageSeconds{{"read", 0.25}}; };
  const std::string timed = Built(Hills(20, 20), options, control);
  EXPECT_GE(Count(timed, "0.250 seconds until this page was made"), 1U);
}

TEST_F(Page, TakesLevelGround) {
  TestRaster flat = Hills(12, 9);
  flat.values.assign(flat.values.size(), 42);
  EXPECT_GE(Count(Sound(flat), "42.0 to 42.0 m"), 1U);
}

TEST_F(Page, TakesOneLevelStripsAndTheLeastGrid) {
  BuildOptions one;
  one.levels = 1;
  Sound(Hills(2, 2), one);
  EXPECT_GE(Count(Sound(Hills(2, 300), one), "drawn wider than it is"), 1U);
  Sound(Hills(300, 2));
}

TEST_F(Page, TakesHoles) {
  TestRaster holes = Hills(24, 20);
  holes.nodata = -9999;
  for (int r = 0; r < 20; ++r) {
    for (int c = 0; c < 24; ++c) {
      const bool hole = (r / 4 == 2 && c / 4 == 2) || c == 11 || c == 12 || c == 13;
      if (hole) holes.values[static_cast<std::size_t>(r * 24 + c)] = -9999;
    }
  }
  EXPECT_GE(Count(Sound(holes), "White: no data"), 1U);
}

TEST_F(Page, TakesGridsThatRunFromSouthToNorth) {
  TestRaster raster = Hills(20, 16);
  raster.geotransform = {{500000, 30, 0, 5100000, 0, 30}};
  Sound(raster);
}

// The name of a reference system is the file's own text.
TEST_F(Page, EscapesTheFilesText) {
  TestRaster raster = Hills(12, 10);
  raster.crs =
      "PROJCS[\"</dd></style><script>alert('1')</script>&\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\","
      "SPHEROID[\"WGS 84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],"
      "UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
      "PARAMETER[\"latitude_of_origin\",1],PARAMETER[\"central_meridian\",-121.2],"
      "PARAMETER[\"scale_factor\",0.9],PARAMETER[\"false_easting\",500000],"
      "PARAMETER[\"false_northing\",7],UNIT[\"metre\",1]]";
  const std::string page = Sound(raster);
  EXPECT_EQ(Count(page, "&lt;script&gt;alert(&#39;1&#39;)"), 1U);
  EXPECT_EQ(Count(page, "<script"), 1U) << "the page's own";
}

// Noise is what pictures compress least.
TEST(MapSection, StaysSmallOnNoise) {
  PictureFrame frame;
  frame.width = frame.height = 960;
  frame.columns = frame.rows = 3600;
  Report report;
  report.levels.resize(12);
  std::vector<GreyPicture> reliefs(13, {960, 960, std::vector<std::uint8_t>(960 * 960)});
  std::uint32_t state = 7;
  for (std::uint8_t& value : reliefs.front().values) {
    state = state * 1664525 + 1013904223;
    value = static_cast<std::uint8_t>(state >> 24U);
  }
  reliefs.assign(13, reliefs.front());
  const Result<Html> map = MapSection({report, {}, frame, reliefs, {1, 0, 0, -1}, 1, 100});
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_LT(map->markup().size(), 6'000'000U);
}

}  // namespace
}  // namespace farhorizon
