// The grids that Debian's proj-data has: EGM96, BETA2007 (Germany), ntf_r93 (France), and a few
// more; none of OSTN15, NADCON, NTv2 of Canada.
#include "core/geo/datum_choice.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geo/globe_transform.h"

namespace farhorizon {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

GlobeTransform MustOpen(const std::string& crs, const GlobeOptions& options = {}) {
  Result<GlobeTransform> globe = GlobeTransform::Open(crs, options);
  if (!globe) throw std::runtime_error(globe.error().message);
  return std::move(*globe);
}

Geodetic Placed(const GlobeTransform& globe, const MapPoint& p) {
  Result<std::vector<Geodetic>> there = globe.ToGeodetic({p});
  if (!there) throw std::runtime_error(there.error().message);
  return there->front();
}

// What is said of the operation; "" where nothing is.
std::string Said(const GlobeTransform& globe) {
  for (const Assumption& assumption : globe.assumptions()) {
    if (assumption.code == "datum-operation") return assumption.text;
  }
  return "";
}

TEST(DatumChoice, DoesNotDependOnWhereTheDemLies) {
  for (const char* crs : {"EPSG:4267", "EPSG:4230", "EPSG:4301", "EPSG:4284", "EPSG:4202"}) {
    // Far apart, so that PROJ by itself would take different operations.
    const MapPoint post = {100, 40, 0};
    const Geodetic here = Placed(MustOpen(crs, {.about = post}), post);
    for (const MapPoint& about : {MapPoint{-79.85, 45.1, 0}, MapPoint{-79.55, 45.1, 0},
                                  MapPoint{8, 46, 0}, MapPoint{140, 36, 0}}) {
      const Geodetic there = Placed(MustOpen(crs, {.about = about}), post);
      EXPECT_EQ(here.lon_deg, there.lon_deg) << crs;
      EXPECT_EQ(here.lat_deg, there.lat_deg) << crs;
    }
  }
}

TEST(DatumChoice, SaysNameAndAccuracyOfAShift) {
  EXPECT_THAT(Said(MustOpen("EPSG:25832")),
              AllOf(HasSubstr("ETRS89 to WGS 84 (1)"), HasSubstr("EPSG:1149, accuracy 1 m")));
  EXPECT_THAT(Said(MustOpen("EPSG:31467")), HasSubstr("DHDN to WGS 84 (4)"));
  EXPECT_THAT(Said(MustOpen("EPSG:4267")), HasSubstr("accuracy 20 m"));
}

TEST(DatumChoice, SaysNothingWhereThereIsNoShift) {
  for (const char* crs :
       {"EPSG:4326", "EPSG:4979", "EPSG:3857", "EPSG:32613", "OGC:CRS84", "EPSG:9057",
        "EPSG:4326+5773", "EPSG:32613+5773", "+proj=utm +zone=13 +datum=WGS84",
        "+proj=utm +zone=13 +datum=WGS84 +vunits=us-ft"}) {
    EXPECT_THAT(MustOpen(crs).assumptions(), IsEmpty()) << crs;
  }
}

TEST(DatumChoice, NamesBetterOperationsWhoseGridsAreMissing) {
  EXPECT_THAT(Said(MustOpen("EPSG:27700")),
              AllOf(HasSubstr("OSGB36 to WGS 84 (6)"), HasSubstr("accuracy 2 m"),
                    HasSubstr("uk_os_OSTN15_NTv2_OSGBtoETRS.tif (1 m)")));
  EXPECT_THAT(Said(MustOpen("EPSG:27700", {.vertical_datum = "EPSG:5773"})),
              HasSubstr("uk_os_OSTN15"));
}

TEST(DatumChoice, NamesTheOperationThatSuitsWhereTheDemLies) {
  const MapPoint kansas = {-98, 38, 0};
  EXPECT_THAT(Said(MustOpen("EPSG:4267", {.about = kansas})),
              AllOf(HasSubstr("the DEM lies elsewhere"),
                    HasSubstr("\"NAD27 to WGS 84 (6)\" (EPSG:1175, accuracy 7 m)"),
                    HasSubstr("--datum-operation EPSG:1175")));
  EXPECT_EQ(Said(MustOpen("EPSG:4267", {.datum_operation = "EPSG:1175", .about = kansas})), "");
  EXPECT_THAT(
      Said(MustOpen("EPSG:4267", {.datum_operation = "EPSG:1175", .about = MapPoint{-75, 45, 0}})),
      HasSubstr("the DEM lies elsewhere"));
}

TEST(DatumChoice, IsStatedByCodeOrNameOrThatOfOneStep) {
  const MapPoint post = {420000, 300000, 0};
  const double by_default = Placed(MustOpen("EPSG:27700"), post).lon_deg;
  const double stated =
      Placed(MustOpen("EPSG:27700", {.datum_operation = "EPSG:1195"}), post).lon_deg;
  EXPECT_NE(by_default, stated);
  for (const char* text : {"epsg:1195", "1195", "OSGB36 to WGS 84 (1)", "osgb36 to wgs 84 (1)"}) {
    const GlobeTransform globe = MustOpen("EPSG:27700", {.datum_operation = text});
    EXPECT_EQ(Placed(globe, post).lon_deg, stated) << text;
    EXPECT_THAT(globe.assumptions(), IsEmpty());
  }
  // The same with heights, where PROJ joins two transformations.
  const GlobeTransform above_geoid =
      MustOpen("EPSG:27700", {.vertical_datum = "EPSG:5773", .datum_operation = "EPSG:1195"});
  EXPECT_NEAR(Placed(above_geoid, post).lon_deg, stated, 1e-7);
}

TEST(DatumChoice, BallparkLeavesCoordinatesAsTheyAre) {
  const Geodetic g = Placed(MustOpen("EPSG:4267", {.datum_operation = "ballpark"}), {-98, 38, 100});
  EXPECT_EQ(g.lon_deg, -98);
  EXPECT_EQ(g.lat_deg, 38);
}

TEST(DatumChoice, RefusesWhatIsNoOperationAndListsThoseThatAre) {
  Result<GlobeTransform> globe = GlobeTransform::Open("EPSG:27700", {.datum_operation = "EPSG:1"});
  ASSERT_FALSE(globe);
  EXPECT_EQ(globe.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(globe.error().message, AllOf(HasSubstr("\"OSGB36 to WGS 84 (1)\" (EPSG:1195"),
                                           HasSubstr("ballpark"), Not(HasSubstr("EPSG:7710"))));
  // No pipeline and no file is taken for one.
  for (const char* text : {"+proj=pipeline +step +proj=noop", "/etc/passwd", "urn:x"}) {
    EXPECT_FALSE(GlobeTransform::Open("EPSG:27700", {.datum_operation = text})) << text;
  }
  globe = GlobeTransform::Open("EPSG:4326", {.datum_operation = "EPSG:1195"});
  ASSERT_FALSE(globe);
  EXPECT_THAT(globe.error().message, HasSubstr("leave --datum-operation out"));
}

TEST(DatumChoice, RefusesAnOperationWhoseGridIsMissingAndNamesIt) {
  Result<GlobeTransform> globe =
      GlobeTransform::Open("EPSG:27700", {.datum_operation = "EPSG:7710"});
  ASSERT_FALSE(globe);
  EXPECT_EQ(globe.error().kind, "no-geoid-grid");
  EXPECT_THAT(globe.error().message, HasSubstr("uk_os_OSTN15"));
}

// PROJ's ways from the ITRF to WGS 84 go by way of Israel or of the United States.
TEST(DatumChoice, OfAGlobalFrameIsNoneOfARegion) {
  for (const char* crs : {"EPSG:9000", "EPSG:8999", "EPSG:7912"}) {
    const Geodetic g = Placed(MustOpen(crs), {8, 46, 500});
    EXPECT_NEAR(g.lon_deg, 8, 1e-9) << crs;
    EXPECT_NEAR(g.lat_deg, 46, 1e-7) << crs;
    EXPECT_NEAR(g.height_m, 500, 0.01) << crs;
    EXPECT_THAT(Said(MustOpen(crs)), HasSubstr("global frames")) << crs;
  }
  EXPECT_THAT(Said(MustOpen("EPSG:4322")), HasSubstr("WGS 72 to WGS 84"));
}

TEST(DatumChoice, SaysWhereADatumIsNotKnown) {
  EXPECT_THAT(Said(MustOpen("+proj=utm +zone=13 +ellps=clrk66")), HasSubstr("ballpark"));
  EXPECT_THAT(Said(MustOpen("+proj=utm +zone=13 +ellps=clrk66 +towgs84=-8,160,176")),
              Not(HasSubstr("ballpark")));
  // A known geoid does not wait for the horizontal datum.
  const GlobeTransform globe =
      MustOpen("+proj=longlat +ellps=GRS80", {.vertical_datum = "EPSG:5773"});
  EXPECT_NEAR(Placed(globe, {8, 46, 1000}).height_m, 1051.853, 0.01);
}

}  // namespace
}  // namespace farhorizon
