#include "core/io/antimeridian.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/geojson_text.h"
#include "core/io/horizon_features.h"
#include "tests/support/published.h"

namespace farhorizon {
namespace {

TEST(Antimeridian, ALineElsewhereStaysWhole) {
  EXPECT_EQ(CutAtAntimeridian({-1, 5, 0}, {1, 6, 0}).size(), 1U);
  EXPECT_EQ(CutAtAntimeridian({179, 5, 0}, {179.5, 6, 0}).size(), 1U);
  EXPECT_EQ(CutAtAntimeridian({-90, 89, 0}, {90, 89, 0}).size(), 1U) << "over the pole";
}

TEST(Antimeridian, ALineAcrossIsCutWhereItCrosses) {
  for (const double sign : {1.0, -1.0}) {
    const auto parts = CutAtAntimeridian({sign * 179, 10, 100}, {sign * -178, 13, 400});
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0][1].lon_deg, sign * 180);
    EXPECT_EQ(parts[1][0].lon_deg, sign * -180);
    for (const Geodetic& p : {parts[0][1], parts[1][0]}) {
      EXPECT_NEAR(p.lat_deg, 11, 1e-12);
      EXPECT_NEAR(p.height_m, 200, 1e-10);
    }
    EXPECT_EQ(parts[0][0].lon_deg, sign * 179);
    EXPECT_EQ(parts[1][1].lon_deg, sign * -178);
  }
}

TEST(Antimeridian, AnEndOnTheMeridianTakesTheOthersSide) {
  const auto parts = CutAtAntimeridian({-179.9999999998, 0, 0}, {179.5, 0, 0});
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0][0].lon_deg, 180);
  EXPECT_EQ(CutAtAntimeridian({-179.5, 0, 0}, {180, 0, 0})[0][1].lon_deg, -180);
  EXPECT_EQ(CutAtAntimeridian({180, 0, 0}, {-180, 1, 0}).size(), 1U);
}

TEST(Antimeridian, AHorizonEdgeAcrossIsTwoLinesThatReadBackAsOne) {
  HorizonFeature edge = SomeFeature();
  edge.from = {179.75, 10, 100};
  edge.to = {-179.75, 11, 200};
  const std::string text = WriteHorizonGeoJson({edge, SomeFeature()});
  const nlohmann::json geometry = nlohmann::json::parse(text)["features"][0]["geometry"];
  EXPECT_EQ(geometry.dump(), R"({"coordinates":[[[179.75,10,100],[180,10.5,150]],)"
                             R"([[-180,10.5,150],[-179.75,11,200]]],"type":"MultiLineString"})");
  Result<std::vector<HorizonFeature>> back = ReadHorizonGeoJson(text);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ((*back)[0].from.lon_deg, 179.75);
  EXPECT_EQ((*back)[0].to.lon_deg, -179.75);
  EXPECT_EQ((*back)[0].to.height_m, 200);
  EXPECT_EQ(WriteHorizonGeoJson(*back), text);
}

}  // namespace
}  // namespace farhorizon
