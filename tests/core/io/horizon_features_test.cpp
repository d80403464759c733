#include "core/io/horizon_features.h"

#include <cmath>

#include <gdal.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <ogr_api.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

HorizonFeature Feature() {
  HorizonFeature feature{};
  feature.a = {3, 4};
  feature.b = {4, 5};
  feature.from = {-84.25, 36.5000000004, 1076};
  feature.to = {-84.1234567891, 36.49, 1075.12349};
  feature.azimuths = {{12.5, 13}, {170.25, 190.125}};
  feature.spans = {{0, 0.25}, {0.5, 1}};
  feature.angular_share = 0.125;
  feature.line_measure_m = 3.5;
  feature.skyline_drop_m = 1.25;
  feature.witness.t = 0.1 + 0.2;
  feature.witness.dc = -7;
  feature.witness.dr = 2;
  return feature;
}

TEST(HorizonGeoJson, MarksWhatIsUndecidedAndSaysHowMuch) {
  HorizonFeature undecided = Feature();
  undecided.undecided = true;
  const std::string text = WriteHorizonGeoJson({Feature(), undecided});
  EXPECT_THAT(text, HasSubstr(R"("approximate":true,"undecided":1,"features":[)"));
  const nlohmann::json json = nlohmann::json::parse(text);
  EXPECT_FALSE(json["features"][0]["properties"].contains("undecided"));
  EXPECT_EQ(json["features"][1]["properties"]["undecided"], true);
  EXPECT_FALSE(json["features"][1]["properties"].contains("witness"));
  const std::vector<HorizonFeature> read = *ReadHorizonGeoJson(text);
  EXPECT_FALSE(read[0].undecided);
  EXPECT_TRUE(read[1].undecided);
  EXPECT_EQ(WriteHorizonGeoJson(read), text);
  EXPECT_THAT(WriteHorizonGeoJson({Feature()}), Not(HasSubstr("approximate")));
}

TEST(HorizonGeoJson, IsTheTextThatTheContractShows) {
  HorizonFeature feature = Feature();
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
  std::vector<HorizonFeature> features = {Feature(), Feature()};
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
    EXPECT_EQ(f.azimuths, features[i].azimuths);
    EXPECT_EQ(f.spans, features[i].spans);
    EXPECT_EQ(f.angular_share, features[i].angular_share);
    EXPECT_EQ(f.line_measure_m, features[i].line_measure_m);
    EXPECT_EQ(f.skyline_drop_m, features[i].skyline_drop_m);
    EXPECT_EQ(f.witness.t, features[i].witness.t);
    EXPECT_EQ(f.witness.dc, features[i].witness.dc);
    EXPECT_EQ(f.witness.dr, features[i].witness.dr);
    EXPECT_EQ(f.level_kept, features[i].level_kept);
  }
}

TEST(HorizonGeoJson, ZeroHasNoSign) {
  HorizonFeature feature = Feature();
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

TEST(HorizonVector, ReadsBackThroughOgrWithAllItsFields) {
  const TempDir dir;
  HorizonFeature feature = Feature();
  feature.level_kept = 1;
  for (const char* name : {"horizon.fgb", "horizon.gpkg"}) {
    Status written = WriteHorizonVector({Feature(), feature, Feature()}, dir / name);
    ASSERT_TRUE(written) << written.error().message;
    const GDALDatasetH dataset =
        GDALOpenEx((dir / name).c_str(), GDAL_OF_VECTOR, nullptr, nullptr, nullptr);
    ASSERT_NE(dataset, nullptr) << name;
    const OGRLayerH layer = GDALDatasetGetLayer(dataset, 0);
    EXPECT_EQ(OGR_L_GetFeatureCount(layer, 1), 3);
    int with_level = 0;
    while (const OGRFeatureH f = OGR_L_GetNextFeature(layer)) {
      EXPECT_EQ(OGR_F_GetFieldAsInteger(f, OGR_F_GetFieldIndex(f, "a_row")), 4);
      EXPECT_EQ(OGR_F_GetFieldAsInteger(f, OGR_F_GetFieldIndex(f, "direction_columns")), -7);
      EXPECT_EQ(OGR_F_GetFieldAsDouble(f, OGR_F_GetFieldIndex(f, "witness_t")), 0.1 + 0.2);
      EXPECT_STREQ(OGR_F_GetFieldAsString(f, OGR_F_GetFieldIndex(f, "azimuths")),
                   "[[12.5,13],[170.25,190.125]]");
      EXPECT_STREQ(OGR_F_GetFieldAsString(f, OGR_F_GetFieldIndex(f, "spans")),
                   "[[0,0.25],[0.5,1]]");
      EXPECT_EQ(OGR_F_GetFieldAsDouble(f, OGR_F_GetFieldIndex(f, "line_measure_m")), 3.5);
      with_level += OGR_F_IsFieldSetAndNotNull(f, OGR_F_GetFieldIndex(f, "level_kept"));
      const OGRGeometryH line = OGR_F_GetGeometryRef(f);
      EXPECT_EQ(OGR_G_GetX(line, 0), -84.25);
      EXPECT_EQ(OGR_G_GetZ(line, 0), 1076);
      OGR_F_Destroy(f);
    }
    EXPECT_EQ(with_level, 1);
    GDALClose(dataset);
  }
}

TEST(HorizonVector, LeavesTheWitnessOfAnUndecidedEdgeNull) {
  const TempDir dir;
  HorizonFeature undecided = Feature();
  undecided.undecided = true;
  for (const char* name : {"horizon.fgb", "horizon.gpkg"}) {
    ASSERT_TRUE(WriteHorizonVector({Feature(), undecided}, dir / name));
    const GDALDatasetH dataset =
        GDALOpenEx((dir / name).c_str(), GDAL_OF_VECTOR, nullptr, nullptr, nullptr);
    ASSERT_NE(dataset, nullptr) << name;
    const OGRLayerH layer = GDALDatasetGetLayer(dataset, 0);
    int with_witness = 0;
    while (const OGRFeatureH f = OGR_L_GetNextFeature(layer)) {
      with_witness += OGR_F_IsFieldSetAndNotNull(f, OGR_F_GetFieldIndex(f, "witness_t"));
      OGR_F_Destroy(f);
    }
    EXPECT_EQ(with_witness, 1) << name;
    GDALClose(dataset);
  }
}

TEST(HorizonVector, SameFeaturesSameBytes) {
  const TempDir dir;
  for (const char* ending : {".fgb", ".gpkg"}) {
    const std::filesystem::path one = dir / (std::string("horizon") + ending);
    ASSERT_TRUE(WriteHorizonVector({Feature()}, one));
    const std::string first = SlurpFile(one);
    ASSERT_TRUE(WriteHorizonVector({Feature()}, one));
    EXPECT_EQ(SlurpFile(one), first) << ending;
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 2);
}

TEST(HorizonVector, FailsWithTheNameAndWithoutTheFolder) {
  const TempDir dir;
  for (const char* name : {"no/such/horizon.fgb", "no/such/horizon.gpkg"}) {
    Status written = WriteHorizonVector({Feature()}, dir / name);
    ASSERT_FALSE(written) << name;
    EXPECT_EQ(written.error().code, ErrorCode::kIo);
    EXPECT_THAT(written.error().message, Not(HasSubstr(dir.path().string())));
  }
  EXPECT_EQ(WriteHorizonVector({}, dir / "horizon.shp").error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace farhorizon
