#include "service/handlers/json_parameters.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(ParametersOfJson, JoinsListsAndKeepsScalars) {
  const Result<Parameters> parameters = ParametersOfJson(
      R"({"levels": 3, "maxError": 0.5, "approximate": true, "formats": ["drc", "geojson"],
          "crs": "EPSG:4326"})");
  ASSERT_TRUE(parameters);
  EXPECT_EQ(*parameters, (Parameters{{"approximate", "true"},
                                     {"crs", "EPSG:4326"},
                                     {"formats", "drc,geojson"},
                                     {"levels", "3"},
                                     {"maxError", "0.5"}}));
}

TEST(ParametersOfJson, KeepsEveryElementOfAList) {
  const Result<Parameters> parameters = ParametersOfJson(
      R"({"nodata": [-9999, "-inf", ""], "levels": 3.0, "formats": [], "triangles": [9, 5.0]})");
  ASSERT_TRUE(parameters);
  EXPECT_EQ(
      *parameters,
      (Parameters{
          {"formats", ""}, {"levels", "3.0"}, {"nodata", "-9999,-inf,"}, {"triangles", "9,5.0"}}));
}

TEST(ParametersOfJson, RefusesOtherShapes) {
  for (const char* text :
       {"[]", "3", R"({"a": {}})", R"({"a": null})", R"({"a": [[1]]})", R"({"a": [{}]})"}) {
    const Result<Parameters> parameters = ParametersOfJson(text);
    ASSERT_FALSE(parameters) << text;
    EXPECT_EQ(parameters.error().kind, "invalid-parameter") << text;
  }
  EXPECT_EQ(ParametersOfJson("{").error().kind, "invalid-json");
}

}  // namespace
}  // namespace farhorizon
