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
                                               {"formats", "drc,geojson"},
                                               {"crs", "EPSG:32610"},
                                               {"verticalDatum", "EPSG:5773"},
                                               {"heightUnit", "us-ft"},
                                               {"datumOperation", "EPSG:1693"},
                                               {"nodata", "-9999"},
                                               {"workBudget", "5000000000"},
                                               {"approximate", "true"}});
  ASSERT_TRUE(options);
  EXPECT_EQ(options->levels, 3);
  EXPECT_EQ(options->max_error_m, 2.5);
  EXPECT_EQ(options->silhouette_error_m, 1);
  EXPECT_EQ(options->formats, (std::vector<std::string>{"drc", "geojson"}));
  EXPECT_EQ(options->crs, "EPSG:32610");
  EXPECT_EQ(options->vertical_datum, "EPSG:5773");
  EXPECT_EQ(options->height_unit, "us-ft");
  EXPECT_EQ(options->datum_operation, "EPSG:1693");
  EXPECT_EQ(options->nodata, std::vector<double>{-9999});
  EXPECT_EQ(options->work_budget, 5'000'000'000);
  EXPECT_TRUE(options->approximate);
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

TEST(FlagOf, WritesAParameterAsTheCommandLineDoes) {
  EXPECT_EQ(FlagOf("crs"), "--crs");
  EXPECT_EQ(FlagOf("silhouetteError"), "--silhouette-error");
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
                    BadParameter{"approximate", "1"}));

TEST(ParseOptions, RefusesTextsWithANul) {
  for (const char* name : {"crs", "verticalDatum", "datumOperation"}) {
    EXPECT_FALSE(ParseOptions({{name, std::string("EPSG:4326\0x", 11)}})) << name;
  }
}

}  // namespace
}  // namespace farhorizon
