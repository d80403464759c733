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
                                               {"nodata", "-9999"},
                                               {"workBudget", "5000000000"},
                                               {"approximate", "true"}});
  ASSERT_TRUE(options);
  EXPECT_EQ(options->levels, 3);
  EXPECT_EQ(options->max_error_m, 2.5);
  EXPECT_EQ(options->silhouette_error_m, 1);
  EXPECT_EQ(options->formats, (std::vector<std::string>{"drc", "geojson"}));
  EXPECT_EQ(options->crs, "EPSG:32610");
  EXPECT_EQ(options->nodata, std::vector<double>{-9999});
  EXPECT_EQ(options->work_budget, 5'000'000'000);
  EXPECT_TRUE(options->approximate);
}

TEST(ParseOptions, NamesWhatItDoesNotKnow) {
  Result<BuildOptions> options = ParseOptions({{"level", "3"}});
  ASSERT_FALSE(options);
  EXPECT_EQ(options.error().kind, "unknown-parameter");
  EXPECT_NE(options.error().message.find("\"level\""), std::string::npos);
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
  EXPECT_NE(options.error().message.find(GetParam().name), std::string::npos)
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
                    BadParameter{"formats", "stl"}, BadParameter{"nodata", "none"},
                    BadParameter{"workBudget", "0"}, BadParameter{"workBudget", "1e9"},
                    BadParameter{"approximate", "1"}));

}  // namespace
}  // namespace farhorizon
