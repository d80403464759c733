#include "core/io/horizon_features.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/published.h"

namespace farhorizon {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(HorizonGeoJson, MarksWhatIsUndecidedAndSaysHowMuch) {
  HorizonFeature undecided = SomeFeature();
  undecided.undecided = true;
  const std::string text = WriteHorizonGeoJson({SomeFeature(), undecided});
  EXPECT_THAT(text, HasSubstr(R"("approximate":true,"undecided":1,"features":[)"));
  const nlohmann::json json = nlohmann::json::parse(text);
  EXPECT_FALSE(json["features"][0]["properties"].contains("undecided"));
  EXPECT_EQ(json["features"][1]["properties"]["undecided"], true);
  EXPECT_FALSE(json["features"][1]["properties"].contains("witness"));
  const std::vector<HorizonFeature> read = *ReadHorizonGeoJson(text);
  EXPECT_FALSE(read[0].undecided);
  EXPECT_TRUE(read[1].undecided);
  EXPECT_EQ(WriteHorizonGeoJson(read), text);
  EXPECT_THAT(WriteHorizonGeoJson({SomeFeature()}), Not(HasSubstr("approximate")));
}

TEST(HorizonGeoJson, HasNullForWhatWasNotAffordedAndNothingForWhatWasNotAskedFor) {
  HorizonFeature not_afforded = SomeFeature();
  not_afforded.measures = {.sights = Known::kNotAfforded, .drop = Known::kNotAfforded};
  HorizonFeature not_asked = SomeFeature();
  not_asked.measures.drop = Known::kNotAsked;
  const std::string text = WriteHorizonGeoJson({not_afforded, not_asked});
  const nlohmann::json json = nlohmann::json::parse(text);
  const nlohmann::json& nulls = json["features"][0]["properties"];
  for (const char* name :
       {"azimuths", "spans", "angular_share", "line_measure_m", "skyline_drop_m"}) {
    EXPECT_TRUE(nulls.at(name).is_null()) << name;
  }
  EXPECT_TRUE(nulls.contains("witness"));
  EXPECT_FALSE(json["features"][1]["properties"].contains("skyline_drop_m"));
  EXPECT_TRUE(json["features"][1]["properties"].contains("azimuths"));
  const std::vector<HorizonFeature> read = *ReadHorizonGeoJson(text);
  EXPECT_EQ(read[0].measures.sights, Known::kNotAfforded);
  EXPECT_EQ(read[0].measures.drop, Known::kNotAfforded);
  EXPECT_EQ(read[1].measures.sights, Known::kYes);
  EXPECT_EQ(read[1].measures.drop, Known::kNotAsked);
  EXPECT_EQ(WriteHorizonGeoJson(read), text);
}

TEST(HorizonGeoJson, SaysWhereAWitnessIsTooNarrowToBeWritten) {
  HorizonFeature feature = SomeFeature();
  feature.witness.exact = false;
  const std::string text = WriteHorizonGeoJson({SomeFeature(), feature});
  EXPECT_THAT(text, HasSubstr(R"("witness":null,"too_narrow":true)"));
  const std::vector<HorizonFeature> read = *ReadHorizonGeoJson(text);
  EXPECT_TRUE(read[0].witness.exact);
  EXPECT_FALSE(read[1].witness.exact);
  EXPECT_EQ(WriteHorizonGeoJson(read), text);
}

TEST(HorizonGeoJson, IsTheTextThatTheContractShows) {
  HorizonFeature feature = SomeFeature();
  feature.level_kept = 2;
  feature.witness.t = 0.5;
  EXPECT_EQ(WriteHorizonGeoJson({feature}),
            "{\"type\":\"FeatureCollection\",\"features\":[\n"
            "{\"type\":\"Feature\",\"geometry\":{\"type\":\"LineString\",\"coordinates\":"
            "[[-84.25,36.5,1076],[-84.123456789,36.49,1075.1235]]},\"properties\":{\"a\":[3,4],"
            "\"b\":[4,5],\"azimuths\":[[12.5,13],[170.25,190.125]],\"spans\":[[0,0.25],[0.5,1]],"
            "\"angular_share\":0.125,\"line_measure_m\":3.5,\"skyline_drop_m\":1.25,"
            "\"witness\":{\"t\":0.5,\"direction\":[-7,2]},\"level_kept\":2}}\n]}\n");
}

TEST(HorizonGeoJson, ReadsBackWhatItWrote) {
  std::vector<HorizonFeature> features = {SomeFeature(), SomeFeature()};
  features[1].level_kept = 0;
  features[1].witness.t = std::ldexp(1.0, -40);
  Result<std::vector<HorizonFeature>> back = ReadHorizonGeoJson(WriteHorizonGeoJson(features));
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const HorizonFeature& f = (*back)[i];
    EXPECT_EQ(f.a, features[i].a);
    EXPECT_EQ(f.b, features[i].b);
    EXPECT_NEAR(f.from.lat_deg, features[i].from.lat_deg, 0.5e-9);
    EXPECT_NEAR(f.to.lon_deg, features[i].to.lon_deg, 0.5e-9);
    EXPECT_NEAR(f.to.height_m, features[i].to.height_m, 0.5e-4);
    EXPECT_EQ(f.measures.azimuths, features[i].measures.azimuths);
    EXPECT_EQ(f.measures.spans, features[i].measures.spans);
    EXPECT_EQ(f.measures.angular_share, features[i].measures.angular_share);
    EXPECT_EQ(f.measures.line_measure_m, features[i].measures.line_measure_m);
    EXPECT_EQ(f.measures.skyline_drop_m, features[i].measures.skyline_drop_m);
    EXPECT_EQ(f.witness.t, features[i].witness.t);
    EXPECT_EQ(f.witness.dc, features[i].witness.dc);
    EXPECT_EQ(f.witness.dr, features[i].witness.dr);
    EXPECT_EQ(f.level_kept, features[i].level_kept);
  }
}

TEST(HorizonGeoJson, ZeroHasNoSign) {
  HorizonFeature feature = SomeFeature();
  feature.from = {-1e-12, 0, -0.00001};
  EXPECT_THAT(WriteHorizonGeoJson({feature}), HasSubstr("[[0,0,0],"));
}

TEST(HorizonGeoJson, NoEdgesAreAnEmptyCollection) {
  Result<std::vector<HorizonFeature>> back = ReadHorizonGeoJson(WriteHorizonGeoJson({}));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->empty());
}

TEST(HorizonGeoJson, RefusesWhatIsNone) {
  for (const char* text :
       {"", "[]", "{\"type\":\"Feature\"}", "{\"type\":\"FeatureCollection\",\"features\":[{}]}"}) {
    EXPECT_FALSE(ReadHorizonGeoJson(text)) << text;
  }
}

}  // namespace
}  // namespace farhorizon
