#include "core/geo/vertical_system.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geo/crs_name.h"
#include "core/geo/globe_transform.h"

namespace farhorizon {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string Found(const std::string& text) {
  ProjSession session;
  Result<ProjObject> heights = ReadVerticalSystem(session, text);
  return heights ? CodeOf(heights->get()) : heights.error().message;
}

double HeightOf(const std::string& crs, const std::string& datum, double z) {
  Result<GlobeTransform> globe = GlobeTransform::Open(crs, {.vertical_datum = datum});
  if (!globe) throw std::runtime_error(globe.error().message);
  Result<std::vector<Geodetic>> there = globe->ToGeodetic({{8, 46, z}});
  if (!there) throw std::runtime_error(there.error().message);
  Result<std::vector<MapPoint>> back = globe->FromGeodetic(*there);
  if (!back) throw std::runtime_error(back.error().message);
  EXPECT_NEAR(back->front().z, z, 1e-6);
  return there->front().height_m;
}

TEST(ReadVerticalSystem, TakesCodesAndTheNamesThatPeopleSay) {
  EXPECT_EQ(Found("EPSG:5773"), "EPSG:5773");
  EXPECT_EQ(Found(" epsg: 5773 "), "EPSG:5773");
  EXPECT_EQ(Found("5773"), "EPSG:5773");
  EXPECT_EQ(Found("EPSG:4326+5773"), "EPSG:5773");
  EXPECT_EQ(Found("EGM96"), "EPSG:5773");
  EXPECT_EQ(Found("egm96 height"), "EPSG:5773");
  EXPECT_EQ(Found("EGM 96"), "EPSG:5773");
  EXPECT_EQ(Found("EGM2008"), "EPSG:3855");
  EXPECT_EQ(Found("NAVD88"), "EPSG:5703");
  EXPECT_EQ(Found("NAVD 88"), "EPSG:5703");
  EXPECT_EQ(Found("NAVD88 height (ftUS)"), "EPSG:6360");
  EXPECT_EQ(Found("MSL"), "EPSG:5714");
  EXPECT_EQ(Found("mean sea level"), "EPSG:5714");
  EXPECT_EQ(Found("ODN"), "EPSG:5701");
  EXPECT_EQ(Found("NAP"), "EPSG:5709");
  EXPECT_EQ(Found("DHHN2016"), "EPSG:7837");
}

TEST(ReadVerticalSystem, ListsTheCodesOfANameThatFitsSeveral) {
  EXPECT_THAT(Found("NGVD29"), AllOf(HasSubstr("EPSG:7968"), HasSubstr("EPSG:5702")));
  EXPECT_THAT(Found("WGS84"), AllOf(HasSubstr("EPSG:5773"), HasSubstr("ellipsoid")));
}

// The remedy is one for vertical datums.
TEST(ReadVerticalSystem, RefusesOthersWithACodeThatItTakes) {
  for (const char* text : {"EPSG:4326", "EPSG:32613", "nonsense", "EPSG:999999", "/etc/passwd",
                           "+proj=pipeline +step +proj=noop"}) {
    EXPECT_THAT(Found(text), AllOf(HasSubstr("EPSG:5773"), Not(HasSubstr("EPSG:4326,")))) << text;
  }
}

TEST(VerticalSystem, MeanSeaLevelIsThatOfEgm96) {
  const double egm96 = HeightOf("EPSG:4326+5773", "", 1000);
  for (const char* datum : {"MSL", "EPSG:5714", "EPSG:5715", "EPSG:8050"}) {
    EXPECT_NEAR(HeightOf("EPSG:4326", datum, 1000), egm96, 1e-6) << datum;
  }
  Result<GlobeTransform> globe = GlobeTransform::Open("EPSG:4326+5714");
  ASSERT_TRUE(globe);
  ASSERT_EQ(globe->assumptions().size(), 1U);
  EXPECT_EQ(globe->assumptions()[0].code, "vertical-datum");
  EXPECT_THAT(globe->assumptions()[0].text, AllOf(HasSubstr("EGM96"), HasSubstr("EPSG:5773")));
}

// A MapPoint's height is in metres upwards, whatever the system counts.
TEST(VerticalSystem, CountsDownwardsAndInFeetAsItsAxisSays) {
  const std::string depths =
      "VERTCRS[\"EGM96 depth\",VDATUM[\"EGM96 geoid\",ID[\"EPSG\",5171]],CS[vertical,1],"
      "AXIS[\"depth (D)\",down,LENGTHUNIT[\"foot\",0.3048]]]";
  EXPECT_NEAR(HeightOf("EPSG:4326", depths, 1000), HeightOf("EPSG:4326", "EPSG:5773", 1000), 1e-6);
  EXPECT_NEAR(HeightOf("+proj=longlat +datum=WGS84 +vunits=us-ft", "", 1000), 1000, 1e-6);
}

// A file with VerticalUnitsGeoKey alone.
TEST(VerticalSystem, AUnitAloneIsNoDatum) {
  const std::string unit_only =
      "COMPD_CS[\"WGS 84 + unknown\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\","
      "6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
      "VERT_CS[\"unknown\",VERT_DATUM[\"unknown\",2005],UNIT[\"foot\",0.3048],AXIS[\"Up\",UP]]]";
  EXPECT_EQ(HeightOf(unit_only, "", 1000), 1000);
  EXPECT_NEAR(HeightOf(unit_only, "EPSG:5773", 1000), 1051.853, 0.002);
}

// GeoTIFF 1.0's code 5030 for heights above the ellipsoid of WGS 84, as GDAL hands it on.
TEST(VerticalSystem, AnEllipsoidMayBeAVerticalDatum) {
  const std::string crs =
      "COMPD_CS[\"unknown\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,"
      "298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],VERT_CS["
      "\"unknown\",VERT_DATUM[\"Not specified (based on WGS 84 ellipsoid)\",2002],"
      "UNIT[\"foot\",0.3048],AXIS[\"Up\",UP]]]";
  EXPECT_NEAR(HeightOf(crs, "", 1000), 1000, 1e-6);
}

TEST(VerticalSystem, AnUnknownDatumIsRefusedWithARemedyThatWorks) {
  Result<GlobeTransform> globe = GlobeTransform::Open("EPSG:4326+5861");  // lowest tide's depth
  ASSERT_FALSE(globe);
  EXPECT_THAT(globe.error().message, HasSubstr("--vertical-datum EPSG:5773"));
  EXPECT_TRUE(GlobeTransform::Open("EPSG:4326+5861", {.vertical_datum = "EPSG:5773"}));
  EXPECT_TRUE(GlobeTransform::Open("EPSG:4326+5861", {.vertical_datum = "ellipsoid"}));
}

TEST(VerticalSystem, AMissingGeoidGridHasARemedyThatWorks) {
  Result<GlobeTransform> globe = GlobeTransform::Open("EPSG:26913+5703");
  ASSERT_FALSE(globe);
  EXPECT_EQ(globe.error().kind, "no-geoid-grid");
  EXPECT_THAT(globe.error().message, HasSubstr("--vertical-datum EPSG:5773"));
  EXPECT_TRUE(GlobeTransform::Open("EPSG:26913+5703", {.vertical_datum = "EPSG:5773"}));
  EXPECT_TRUE(GlobeTransform::Open("EPSG:26913+5703", {.vertical_datum = "ellipsoid"}));
}

}  // namespace
}  // namespace farhorizon
