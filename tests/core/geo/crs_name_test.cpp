#include "core/geo/crs_name.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "core/geo/globe_transform.h"

namespace farhorizon {
namespace {

std::string NameIn(const std::string& crs, const std::string& datum = "") {
  Result<GlobeTransform> globe = GlobeTransform::Open(crs, {.vertical_datum = datum});
  if (!globe) throw std::runtime_error(globe.error().message);
  return globe->Name();
}

TEST(NameOf, IsTheCodeWhereThereIsOne) {
  EXPECT_EQ(NameIn("EPSG:4326"), "EPSG:4326");
  EXPECT_EQ(NameIn("WGS 84 / UTM zone 13N"), "EPSG:32613");
  EXPECT_EQ(NameIn("EPSG:4326", "EPSG:5773"), "EPSG:4326+5773");
  EXPECT_EQ(NameIn("EPSG:4326+5773"), "EPSG:4326+5773");
  EXPECT_EQ(NameIn("ESRI:102003"), "ESRI:102003");
}

TEST(NameOf, IsTheCodeOfAnEquivalentSystemWhereItsOwnIsMissing) {
  EXPECT_EQ(NameIn("+proj=utm +zone=13 +datum=WGS84"), "EPSG:32613");
  EXPECT_EQ(NameIn("+proj=longlat +datum=WGS84"), "EPSG:4326");
  EXPECT_EQ(NameIn("+proj=utm +zone=13 +datum=WGS84", "EGM96"), "EPSG:32613+5773");
  // As GDAL writes a system without its code.
  EXPECT_EQ(NameIn("PROJCS[\"unknown\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\","
                   "6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\","
                   "0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],PARAMETER["
                   "\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",-105],PARAMETER["
                   "\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],PARAMETER["
                   "\"false_northing\",0],UNIT[\"metre\",1]]"),
            "EPSG:32613");
}

TEST(NameOf, IsThatOfTheMapWhereHeightsAreAboveItsEllipsoid) {
  EXPECT_EQ(NameIn("+proj=utm +zone=13 +datum=WGS84 +vunits=us-ft"), "EPSG:32613");
  EXPECT_EQ(NameIn("EPSG:4979"), "EPSG:4979");
}

TEST(NameOf, IsTheProjStringOfWhatIsUnnamedAndNoOther) {
  // A datum that is not known is not WGS 84, however alike their ellipsoids are.
  EXPECT_EQ(NameIn("+proj=utm +zone=13 +ellps=GRS80"), "+proj=utm +zone=13 +ellps=GRS80 +units=m");
  EXPECT_EQ(NameIn("+proj=tmerc +lat_0=0 +lon_0=-104 +datum=WGS84"),
            "+proj=tmerc +lat_0=0 +lon_0=-104 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m");
}

TEST(IsUnnamed, KnowsWhatWritersPutForANameThatTheyLack) {
  for (const char* name :
       {"", "unknown", "Unknown", "unnamed", "Unknown datum based upon GRS 80"}) {
    EXPECT_TRUE(IsUnnamed(name)) << name;
  }
  EXPECT_FALSE(IsUnnamed("WGS 84"));
}

}  // namespace
}  // namespace farhorizon
