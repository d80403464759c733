#include "service/handlers/parameter_names.h"

#include <gtest/gtest.h>

#include "core/pipeline/build_options.h"

namespace farhorizon {
namespace {

TEST(WithParameterNames, NamesEveryFlagOfABuildByItsParameter) {
  for (const std::string_view name : ParameterNames()) {
    EXPECT_EQ(WithParameterNames("give " + FlagOf(name) + "; or (" + FlagOf(name) + ")"),
              "give " + std::string(name) + "; or (" + std::string(name) + ")");
  }
}

TEST(WithParameterNames, WritesAValueAsAQueryDoes) {
  EXPECT_EQ(WithParameterNames("give --nodata -9999 or --nodata=-inf, --nodata 0"),
            "give nodata=-9999 or nodata=-inf, nodata=0");
  EXPECT_EQ(WithParameterNames("--crs EPSG:4326+5773 and --height-unit us-ft."),
            "crs=EPSG:4326+5773 and heightUnit=us-ft.");
  EXPECT_EQ(WithParameterNames("--height-unit m, ft or us-ft; --vertical-datum ellipsoid"),
            "heightUnit m, ft or us-ft; verticalDatum=ellipsoid");
  EXPECT_EQ(WithParameterNames("is --crs right? name it with --crs, for example EPSG:4326"),
            "is crs right? name it with crs, for example EPSG:4326");
  EXPECT_EQ(WithParameterNames("--height-unit m|ft|us-ft, --crs metres"),
            "heightUnit m|ft|us-ft, crs metres");
}

TEST(WithParameterNames, LeavesOtherWordsAsTheyAre) {
  for (const char* text :
       {"", "-", "--", "a -- b", "--listen 127.0.0.1:80", "gdal_translate -a_nodata -9999 IN OUT",
        "--crsx", "x--crs", "---crs", "--no-data", "nodata", "-crs", "--crs-", "\xC3\xA9 --"}) {
    EXPECT_EQ(WithParameterNames(text), text);
  }
}

}  // namespace
}  // namespace farhorizon
