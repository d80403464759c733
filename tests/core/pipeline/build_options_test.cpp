#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/build.h"

namespace farhorizon {
namespace {

TEST(ParseOptions, ReadsTheParametersOfAJob) {
  Result<BuildOptions> options = ParseOptions({{"levels", "3"},
                                               {"maxError", "2.5"},
                                               {"silhouetteError", "1"},
                                               {"formats", "drc,geopackage"},
                                               {"crs", "EPSG:32610"},
                                               {"verticalDatum", "EPSG:5773"},
                                               {"heightUnit", "us-ft"},
                                               {"datumOperation", "EPSG:1693"},
                                               {"nodata", "-9999"},
                                               {"workBudget", "5000000000"},
                                               {"approximate", "true"},
                                               {"skirt", "12.5"},
                                               {"tileTriangles", "5e4"},
                                               {"frame", "7.5,-46"},
                                               {"apron", "8"}});
  ASSERT_TRUE(options);
  EXPECT_EQ(options->levels, 3);
  EXPECT_EQ(options->max_error_m, 2.5);
  EXPECT_EQ(options->silhouette_error_m, 1);
  EXPECT_EQ(options->formats, (std::vector<std::string>{"drc", "geopackage"}));
  EXPECT_EQ(options->crs, "EPSG:32610");
  EXPECT_EQ(options->vertical_datum, "EPSG:5773");
  EXPECT_EQ(options->height_unit, "us-ft");
  EXPECT_EQ(options->datum_operation, "EPSG:1693");
  EXPECT_EQ(options->nodata, std::vector<double>{-9999});
  EXPECT_EQ(options->work_budget, 5'000'000'000);
  EXPECT_TRUE(options->approximate);
  EXPECT_EQ(options->skirt_m, 12.5);
  EXPECT_EQ(options->tile_triangles, 50'000);
  EXPECT_EQ(options->apron, 8);
  EXPECT_EQ(options->frame, (FrameChoice{FrameAxes::kPlace, 7.5, -46}));
}

TEST(ParseOptions, LeavesTheDepthOfSkirtsToTheLevels) {
  EXPECT_EQ(ParseOptions({})->skirt_m, std::nullopt);
  EXPECT_EQ(ParseOptions({{"skirt", "auto"}})->skirt_m, std::nullopt);
  EXPECT_EQ(ParseOptions({{"skirt", "0"}})->skirt_m, 0);
}

TEST(ParseOptions, NamesWhatItDoesNotKnow) {
  Result<BuildOptions> options = ParseOptions({{"level", "3"}});
  ASSERT_FALSE(options);
  EXPECT_EQ(options.error().kind, "unknown-parameter");
  EXPECT_NE(options.error().message.find("\"level\""), std::string::npos);
  for (const std::string_view name : ParameterNames()) {
    EXPECT_NE(options.error().message.find(name), std::string::npos) << name;
  }
}

TEST(ParseOptions, TakesSeveralValuesForNoData) {
  const auto nodata = [](const std::string& text) {
    Result<BuildOptions> options = ParseOptions({{"nodata", text}});
    return options ? options->nodata : std::vector<double>();
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(nodata("-9999,-32767, 0"), (std::vector<double>{-9999, -32767, 0}));
  EXPECT_EQ(nodata("-inf,+1e3"), (std::vector<double>{-kInfinity, 1000}));
}

TEST(ParseOptions, TakesWholeNumbersHoweverTheyAreWritten) {
  for (const char* three : {"3", "3.0", "3e0"}) {
    Result<BuildOptions> options = ParseOptions({{"levels", three}, {"workBudget", "1e6"}});
    ASSERT_TRUE(options) << three << ": " << options.error().message;
    EXPECT_EQ(options->levels, 3) << three;
    EXPECT_EQ(options->work_budget, 1'000'000) << three;
  }
}

TEST(ParseOptions, TakesTrianglesInAnyOrder) {
  for (const char* text : {"9000,3000,2", "2,9000,3000", "3e3, 9000.0 ,2"}) {
    Result<BuildOptions> options = ParseOptions({{"triangles", text}});
    ASSERT_TRUE(options) << text << ": " << options.error().message;
    EXPECT_EQ(options->triangles, (std::vector<std::int64_t>{9000, 3000, 2})) << text;
  }
  EXPECT_TRUE(ParseOptions({{"triangles", "12,11,10,9,8,7,6,5,4,3,2,1000000000"}}));
}

TEST(ParseOptions, TrianglesTakeThePlaceOfThreeOthers) {
  for (const char* other : {"levels", "maxError", "silhouetteError"}) {
    Result<BuildOptions> options = ParseOptions({{"triangles", "500"}, {other, "1"}});
    ASSERT_FALSE(options) << other;
    EXPECT_EQ(options.error().kind, "invalid-parameter");
    for (const char* flag : {"--triangles", "--levels", "--max-error", "--silhouette-error"}) {
      EXPECT_NE(options.error().message.find(flag), std::string::npos) << options.error().message;
    }
  }
  EXPECT_TRUE(ParseOptions({{"triangles", "500"}, {"formats", "drc"}}));
}

TEST(FlagOf, WritesAParameterAsTheCommandLineDoes) {
  EXPECT_EQ(FlagOf("crs"), "--crs");
  EXPECT_EQ(FlagOf("silhouetteError"), "--silhouette-error");
}

TEST(ParseOptions, EdgesAreOneOfFourWords) {
  EXPECT_EQ(BuildOptions().edges, EdgeFiles::kLines);
  EXPECT_EQ(ParseOptions({{"edges", "lines"}})->edges, EdgeFiles::kLines);
  EXPECT_EQ(ParseOptions({{"edges", "inline"}})->edges, EdgeFiles::kInline);
  EXPECT_EQ(ParseOptions({{"edges", "both"}})->edges, EdgeFiles::kBoth);
  EXPECT_EQ(ParseOptions({{"edges", "none"}})->edges, EdgeFiles::kNone);
  const Error error = ParseOptions({{"edges", "some"}}).error();
  EXPECT_NE(error.message.find("lines, inline, both, none"), std::string::npos) << error.message;
}

struct BadParameter {
  const char* name;
  const char* value;
};

class BadParameters : public testing::TestWithParam<BadParameter> {};

TEST_P(BadParameters, AreRefusedByNameAndValue) {
  Result<BuildOptions> options = ParseOptions({{GetParam().name, GetParam().value}});
  ASSERT_FALSE(options);
  EXPECT_EQ(options.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(options.error().kind, "invalid-parameter");
  EXPECT_NE(options.error().message.find(FlagOf(GetParam().name)), std::string::npos)
      << options.error().message;
}

INSTANTIATE_TEST_SUITE_P(
    OutOfRangeOrNoNumber, BadParameters,
    testing::Values(BadParameter{"levels", "0"}, BadParameter{"levels", "13"},
                    BadParameter{"levels", "3.5"}, BadParameter{"levels", ""},
                    BadParameter{"levels", "99999999999"}, BadParameter{"maxError", "0"},
                    BadParameter{"maxError", "-1"}, BadParameter{"maxError", "nan"},
                    BadParameter{"maxError", "inf"}, BadParameter{"maxError", "3m"},
                    BadParameter{"skirt", "-1"}, BadParameter{"skirt", "deep"},
                    BadParameter{"tileTriangles", "999"}, BadParameter{"tileTriangles", "-1"},
                    BadParameter{"tileTriangles", "all"}, BadParameter{"apron", "-1"},
                    BadParameter{"apron", "1001"}, BadParameter{"horizonContext", "yes"},
                    BadParameter{"horizonContext", "true"}, BadParameter{"frame", ""},
                    BadParameter{"frame", "7"}, BadParameter{"frame", "7,91"},
                    BadParameter{"frame", "7,46,500"}, BadParameter{"frame", "nan,46"},
                    BadParameter{"silhouetteError", "-0.5"}, BadParameter{"formats", ""},
                    BadParameter{"formats", "stl"}, BadParameter{"nodata", ""},
                    BadParameter{"nodata", "1,"}, BadParameter{"nodata", "none"},
                    BadParameter{"nodata", "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17"},
                    BadParameter{"workBudget", "0"}, BadParameter{"workBudget", "1.5e0"},
                    BadParameter{"workBudget", "1e19"}, BadParameter{"workBudget", "inf"},
                    BadParameter{"levels", "nan"}, BadParameter{"levels", "3e10"},
                    BadParameter{"heightUnit", ""}, BadParameter{"heightUnit", "feet"},
                    BadParameter{"heightUnit", "M"}, BadParameter{"crs", ""},
                    BadParameter{"verticalDatum", ""}, BadParameter{"datumOperation", ""},
                    BadParameter{"approximate", "1"}, BadParameter{"triangles", ""},
                    BadParameter{"triangles", "1"}, BadParameter{"triangles", "500,0"},
                    BadParameter{"triangles", "-500"}, BadParameter{"triangles", "1e9,1000000001"},
                    BadParameter{"triangles", "500,500"}, BadParameter{"triangles", "500,5e2"},
                    BadParameter{"triangles", "500,"}, BadParameter{"triangles", "0.5"},
                    BadParameter{"triangles", "half"}, BadParameter{"edges", ""},
                    BadParameter{"horizonDetail", "edge"}, BadParameter{"edges", "Lines"},
                    BadParameter{"edges", "lines,inline"},
                    BadParameter{"triangles", "2,3,4,5,6,7,8,9,10,11,12,13,14"}));

TEST(ParseOptions, RefusesTextsWithANul) {
  for (const char* name : {"crs", "verticalDatum", "datumOperation"}) {
    EXPECT_FALSE(ParseOptions({{name, std::string("EPSG:4326\0x", 11)}})) << name;
  }
}

}  // namespace
}  // namespace farhorizon
