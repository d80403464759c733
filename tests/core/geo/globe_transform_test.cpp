#include "core/geo/globe_transform.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/oracles/frames_by_formula.h"

namespace farhorizon {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

GlobeTransform MustOpenTransform(const std::string& crs, const std::string& datum = "",
                                 std::optional<MapPoint> about = std::nullopt) {
  Result<GlobeTransform> globe =
      GlobeTransform::Open(crs, {.vertical_datum = datum, .about = about});
  if (!globe) throw std::runtime_error(globe.error().message);
  return std::move(*globe);
}

Geodetic OnGlobe(const GlobeTransform& globe, MapPoint p) {
  Result<std::vector<Geodetic>> there = globe.ToGeodetic({p});
  if (!there) throw std::runtime_error(there.error().message);
  return there->front();
}

std::string KindOf(const std::string& crs, const std::string& datum = "") {
  Result<GlobeTransform> globe = GlobeTransform::Open(crs, {.vertical_datum = datum});
  return globe ? "opened" : std::string(globe.error().kind);
}

TEST(GlobeTransform, GeocentricAgreesWithTheClosedFormula) {
  const GlobeTransform globe = MustOpenTransform("EPSG:4326");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> lon(-180, 180);
  std::uniform_real_distribution<double> lat(-90, 90);
  std::uniform_real_distribution<double> height(-500, 9000);
  std::vector<Geodetic> points;
  for (int i = 0; i < 1000; ++i) points.push_back({lon(random), lat(random), height(random)});
  Result<std::vector<Ecef>> there = globe.ToEcef(points);
  ASSERT_TRUE(there);
  Result<std::vector<Geodetic>> back = globe.FromEcef(*there);
  ASSERT_TRUE(back);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Ecef expected = by_formula::ToEcef(points[i]);
    EXPECT_NEAR((*there)[i].x, expected.x, 1e-8);
    EXPECT_NEAR((*there)[i].y, expected.y, 1e-8);
    EXPECT_NEAR((*there)[i].z, expected.z, 1e-8);
    const Geodetic formula = by_formula::ToGeodetic(expected);
    EXPECT_NEAR((*back)[i].lat_deg, formula.lat_deg, 1e-11);
    EXPECT_NEAR((*back)[i].height_m, formula.height_m, 1e-6);
    EXPECT_NEAR((*back)[i].lon_deg, points[i].lon_deg, 1e-11);
  }
}

TEST(GlobeTransform, WebMercatorAgreesWithTheClosedFormula) {
  const GlobeTransform globe = MustOpenTransform("EPSG:3857");
  const Geodetic g = OnGlobe(globe, {-13630000, 4540000, 12.5});
  const std::array<double, 2> expected = by_formula::FromWebMercator(-13630000, 4540000);
  EXPECT_NEAR(g.lon_deg, expected[0], 1e-12);
  EXPECT_NEAR(g.lat_deg, expected[1], 1e-12);
  EXPECT_EQ(g.height_m, 12.5);
}

TEST(GlobeTransform, UtmAgreesWithTheClosedFormula) {
  const GlobeTransform globe =
      MustOpenTransform("EPSG:32644");  // zone 44 north, central meridian 81
  for (const double x : {250000.0, 500000.0, 700000.0}) {
    for (const double y : {100000.0, 3400000.0, 8000000.0}) {
      const Geodetic g = OnGlobe(globe, {x, y, 0});
      const std::array<double, 2> back = by_formula::ToUtm(g.lon_deg, g.lat_deg, 81);
      EXPECT_NEAR(back[0], x, 2e-5);
      EXPECT_NEAR(back[1], y, 2e-5);
    }
  }
}

TEST(GlobeTransform, OrderIsAlwaysEastThenNorth) {
  // EPSG:4326 and EPSG:2193 (New Zealand) put north first by their authority.
  const Geodetic g = OnGlobe(MustOpenTransform("EPSG:4326"), {8, 46, 0});
  EXPECT_EQ(g.lon_deg, 8);
  EXPECT_EQ(g.lat_deg, 46);
  const Geodetic nz = OnGlobe(MustOpenTransform("EPSG:2193"), {1600000, 5400000, 0});
  EXPECT_NEAR(nz.lon_deg, 173, 1e-6);
  EXPECT_NEAR(nz.lat_deg, -41.5, 0.1);
}

// NAD27 to WGS 84 moves places of the western United States by some 90 m west and 0 to 20 m, and by
// about 200 m north on UTM grids; never by nothing. Heights of a system without heights stay.
TEST(GlobeTransform, Nad27IsShiftedAndItsHeightsPass) {
  for (const char* crs : {"EPSG:26710", "EPSG:26713"}) {
    const MapPoint p = {560000, 5110000, 2543};
    const GlobeTransform globe = MustOpenTransform(crs, "", p);
    const Geodetic g = OnGlobe(globe, p);
    EXPECT_EQ(g.height_m, 2543);
    const double meridian = std::string(crs) == "EPSG:26710" ? -123 : -105;
    const std::array<double, 2> wgs84 = by_formula::ToUtm(g.lon_deg, g.lat_deg, meridian);
    EXPECT_NEAR(wgs84[0] - p.x, -80, 60) << crs;
    EXPECT_NEAR(wgs84[1] - p.y, 210, 30) << crs;
  }
}

TEST(GlobeTransform, OneWayIsTakenForAllPoints) {
  // Two points either side of the meridian where PROJ changes its NAD27 operation must not tear:
  // a hundredth of a degree apart on the map, as much apart on the globe.
  const MapPoint about = {-90, 40, 0};
  const GlobeTransform globe = MustOpenTransform("EPSG:4267", "", about);
  std::vector<MapPoint> points;
  for (int i = 0; i <= 4000; ++i) points.push_back({-110 + i * 0.01, 40, 0});
  Result<std::vector<Geodetic>> there = globe.ToGeodetic(points);
  ASSERT_TRUE(there);
  for (std::size_t i = 1; i < there->size(); ++i) {
    EXPECT_NEAR((*there)[i].lon_deg - (*there)[i - 1].lon_deg, 0.01, 1e-6);
    EXPECT_NEAR((*there)[i].lat_deg - (*there)[i - 1].lat_deg, 0, 1e-6);
  }
}

TEST(GlobeTransform, LongitudesBeyondHalfATurnComeBackWhereTheDemHasThem) {
  const MapPoint p = {271, 38, 10};
  const GlobeTransform globe = MustOpenTransform("EPSG:4326", "", p);
  const Geodetic g = OnGlobe(globe, p);
  EXPECT_EQ(g.lon_deg, -89);
  Result<std::vector<MapPoint>> back = globe.FromGeodetic({g});
  ASSERT_TRUE(back);
  EXPECT_EQ(back->front().x, 271);
}

TEST(GlobeTransform, VerticalDatumMayComeWithTheSystemOrBesideIt) {
  const Geodetic beside = OnGlobe(MustOpenTransform("EPSG:4326", "EPSG:5773"), {8, 46, 1000});
  const Geodetic within = OnGlobe(MustOpenTransform("EPSG:4326+5773"), {8, 46, 1000});
  EXPECT_NEAR(beside.height_m, 1051.853, 0.002);  // measured with cs2cs
  EXPECT_EQ(beside.height_m, within.height_m);
  const Geodetic projected =
      OnGlobe(MustOpenTransform("EPSG:32632", "EPSG:5773"), {500000, 5100000, 1000});
  EXPECT_GT(projected.height_m, 1040);
  const Geodetic dropped = OnGlobe(MustOpenTransform("EPSG:4326+5773", "ellipsoid"), {8, 46, 1000});
  EXPECT_EQ(dropped.height_m, 1000);
}

// The points of NGA's INPUT.DAT and the undulations that its program F477 makes of them, from the
// model's harmonics; Debian's grid has 15 minutes, and PROJ interpolates it linearly.
TEST(GlobeTransform, Egm96AgreesWithItsMakersTestPoints) {
  struct TestPoint {
    double lat_deg;
    double lon_deg;
    double undulation_m;
  };
  const GlobeTransform globe = MustOpenTransform("EPSG:4326+5773");
  for (const TestPoint& p :
       {TestPoint{38.6281550, -90.2208450, -31.628}, TestPoint{-14.6212170, -54.9788860, -2.969},
        TestPoint{46.8743190, 102.4487290, -43.575}, TestPoint{-23.6174460, 133.8747120, 15.871},
        TestPoint{38.6254730, -0.0005000, 50.066}, TestPoint{-0.4667440, 0.0023000, 17.329}}) {
    EXPECT_NEAR(OnGlobe(globe, {p.lon_deg, p.lat_deg, 0}).height_m, p.undulation_m, 0.1);
  }
}

TEST(GlobeTransform, HeightsComeInMetresWhateverTheVerticalUnitOfTheSystem) {
  // EGM96 heights counted in US survey feet: a system of its own, by WKT.
  const std::string feet =
      "COMPOUNDCRS[\"WGS 84 + EGM96 (ftUS)\",GEOGCRS[\"WGS 84\",DATUM[\"World Geodetic System "
      "1984\",ELLIPSOID[\"WGS 84\",6378137,298.257223563]],CS[ellipsoidal,2],AXIS[\"geodetic "
      "latitude (Lat)\",north],AXIS[\"geodetic longitude (Lon)\",east],ANGLEUNIT[\"degree\","
      "0.0174532925199433],ID[\"EPSG\",4326]],VERTCRS[\"EGM96 height (ftUS)\",VDATUM[\"EGM96 "
      "geoid\",ID[\"EPSG\",5171]],CS[vertical,1],AXIS[\"gravity-related height (H)\",up,"
      "LENGTHUNIT[\"US survey foot\",0.304800609601219]]]]";
  Result<GlobeTransform> globe = GlobeTransform::Open(feet);
  ASSERT_TRUE(globe) << globe.error().message;
  EXPECT_NEAR(OnGlobe(*globe, {8, 46, 1000}).height_m, 1051.853, 0.002);
}

TEST(GlobeTransform, AMissingGeoidGridFailsAndIsNamed) {
  Result<GlobeTransform> globe =
      GlobeTransform::Open("EPSG:4326", {.vertical_datum = "EPSG:3855"});  // EGM2008
  ASSERT_FALSE(globe);
  EXPECT_EQ(globe.error().kind, "no-geoid-grid");
  EXPECT_THAT(globe.error().message, HasSubstr("egm08"));
}

TEST(GlobeTransform, RefusesSystemsThatAreNotOnEarth) {
  EXPECT_EQ(KindOf("LOCAL_CS[\"site grid\",UNIT[\"metre\",1]]"), "local-crs");
  EXPECT_EQ(KindOf("ENGCRS[\"site grid\",EDATUM[\"site\"],CS[Cartesian,2],AXIS[\"x\",east],"
                   "AXIS[\"y\",north],LENGTHUNIT[\"metre\",1]]"),
            "local-crs");
  for (const char* crs : {"ESRI:104903", "IAU_2015:49900", "+proj=longlat +R=1737400"}) {
    Result<GlobeTransform> globe = GlobeTransform::Open(crs);  // the Moon, Mars
    ASSERT_FALSE(globe) << crs;
    EXPECT_EQ(globe.error().kind, "unknown-crs") << crs;
    EXPECT_THAT(globe.error().message, HasSubstr("not one of the Earth")) << crs;
  }
  EXPECT_EQ(KindOf("+proj=longlat +R=6371000"), "opened");  // a sphere of the Earth's size
}

TEST(GlobeTransform, ReadsSystemsAsPeopleWriteThem) {
  const Geodetic expected = OnGlobe(MustOpenTransform("EPSG:32613"), {500000, 4500000, 0});
  for (const char* crs : {"32613", "EPSG 32613", "+init=epsg:32613", "WGS 84 / UTM zone 13N",
                          "+proj=utm +zone=13 +datum=WGS84 +units=m", "urn:ogc:def:crs:EPSG::32613",
                          "proj=utm zone=13 datum=WGS84"}) {
    const Geodetic g = OnGlobe(MustOpenTransform(crs), {500000, 4500000, 0});
    EXPECT_EQ(g.lon_deg, expected.lon_deg) << crs;
    EXPECT_EQ(g.lat_deg, expected.lat_deg) << crs;
  }
  EXPECT_EQ(OnGlobe(MustOpenTransform("OGC:CRS84"), {8, 46, 0}).lon_deg, 8);
  // A rotated pole, as climate models have it: the grid's pole is at 39.25 north, 18 east + 180.
  const Geodetic rotated = OnGlobe(
      MustOpenTransform(
          "+proj=ob_tran +o_proj=longlat +o_lon_p=-162 +o_lat_p=39.25 +lon_0=180 +R=6371000"),
      {0, 90, 0});
  EXPECT_NEAR(rotated.lat_deg, 39.25, 1e-6);
}

TEST(GlobeTransform, SaysWhereADemLiesFarFromTheAreaOfItsSystem) {
  const auto codes = [](const std::string& crs, MapPoint about) {
    std::vector<std::string> found;
    const GlobeTransform globe = MustOpenTransform(crs, "", about);
    for (const Assumption& assumption : globe.assumptions()) {
      found.push_back(assumption.code);
    }
    return found;
  };
  EXPECT_THAT(codes("EPSG:32613", {500000, 4500000, 0}), IsEmpty());
  EXPECT_THAT(codes("EPSG:32613", {100000, 4500000, 0}), IsEmpty());
  EXPECT_THAT(codes("EPSG:32613", {-1500000, 4500000, 0}), ElementsAre("outside-area"));
  EXPECT_THAT(codes("EPSG:32760", {500000, 6000000, 0}), IsEmpty());         // next to 180 degrees
  EXPECT_THAT(codes("EPSG:2193", {174, -41, 0}), Contains("outside-area"));  // degrees as metres
  EXPECT_THAT(codes("EPSG:4326", {174, -41, 0}), IsEmpty());
}

TEST(GlobeTransform, NamesTheOperationWhoseGridEnds) {
  // BETA2007, the grid of Germany, ends well before Spain.
  Result<GlobeTransform> globe =
      GlobeTransform::Open("EPSG:31467", {.about = MapPoint{3000000, 4300000, 0}});
  ASSERT_FALSE(globe);
  EXPECT_EQ(globe.error().kind, "outside-crs");
  EXPECT_THAT(globe.error().message, HasSubstr("DHDN to WGS 84 (4)"));
}

TEST(GlobeTransform, RefusesWhatIsNoSystemOfMaps) {
  EXPECT_EQ(KindOf(""), "no-crs");
  EXPECT_EQ(KindOf("EPSG:999999"), "unknown-crs");
  EXPECT_EQ(KindOf("nonsense"), "unknown-crs");
  EXPECT_EQ(KindOf("EPSG:5773"), "unknown-crs");  // vertical only
  EXPECT_EQ(KindOf("EPSG:4978"), "unknown-crs");  // geocentric
  EXPECT_EQ(KindOf("EPSG:9122"), "unknown-crs");  // a unit
  EXPECT_EQ(KindOf("EPSG:4326", "EPSG:4326"), "unknown-crs");
  EXPECT_EQ(KindOf("https://example.org/4326"), "unknown-crs");
  EXPECT_EQ(KindOf("EPSG:4326", "/etc/passwd"), "unknown-crs");
}

TEST(GlobeTransform, RefusesPointsOutsideTheSystem) {
  const GlobeTransform globe = MustOpenTransform("EPSG:4326");
  Result<std::vector<Geodetic>> there = globe.ToGeodetic({{8, 46, 0}, {8, 95, 0}});
  ASSERT_FALSE(there);
  EXPECT_EQ(there.error().kind, "outside-crs");
  EXPECT_THAT(there.error().message, HasSubstr("point 1 (8, 95)"));
  EXPECT_FALSE(MustOpenTransform("EPSG:32644").ToGeodetic({{1e12, 1e12, 0}}));
  Result<GlobeTransform> bad =
      GlobeTransform::Open("EPSG:32644", {.about = MapPoint{1e12, 1e12, 0}});
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().kind, "outside-crs");
}

}  // namespace
}  // namespace farhorizon
