#include "core/geo/named_files.h"

#include <string>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(NamedFileIn, LetsReferenceSystemsPass) {
  for (const char* text :
       {"EPSG:4326", "WGS 84", "OSGB 1936 / British National Grid", "NAD83(HARN)",
        "+proj=longlat +datum=WGS84 +no_defs +type=crs", "proj=utm zone=10 south type=crs",
        "+proj=merc +a=6378137 +b=6378137 +lat_ts=0 +units=m +nadgrids=@null +wktext +type=crs",
        "+proj=tmerc +lat_0=49d30'N +lon_0=-2 +towgs84=446.448,-125.157,542.06,0.15,0.247,0.842,"
        "-20.489 +type=crs",
        "PROJCS[\"British National Grid\",EXTENSION[\"PROJ4\",\"+proj=merc +nadgrids=@null "
        "+wktext +no_defs\"],AUTHORITY[\"EPSG\",\"3857\"]]",
        "GEOGCRS[\"x\",REMARK[\"see https://example.org/a?b=c#d\"]]",
        R"({"type": "ProjectedCRS", "name": "a \"b\"", "parameters": [{"value": 0.9996}]})"}) {
    EXPECT_EQ(NamedFileIn(text), nullptr) << text;
  }
}

TEST(NamedFileIn, SeesAGridHoweverItIsSpelt) {
  for (const char* blank : {"", " ", "\t", "\n", "\r", "\v", "\f", " \t \n", ";", "#x\n", "+"}) {
    for (const char* name : {"geoidgrids", "nadgrids", "grids", "xy_grids", "GeoidGrids"}) {
      for (const char* value : {"/tmp/canary", "@/tmp/canary", "egm96_15.gtx", "\"egm96_15.gtx\"",
                                "https://example.org/g.tif", "@null,/tmp/canary"}) {
        const std::string word = std::string("+") + name + blank + "=" + blank + value;
        for (const std::string& text :
             {"+proj=longlat +datum=WGS84 " + word + " +vunits=m +type=crs",
              "GEOGCS[\"x\",EXTENSION[\"PROJ4\",\"+proj=longlat " + word + "\"]]",
              "GEOGCRS(\"x\",REMARK(\"PROJ CRS string: +proj=longlat " + word + "\"))",
              R"({"type": "GeographicCRS", "remarks": "PROJ CRS string: +proj=longlat )" + word +
                  "\"}"}) {
          EXPECT_NE(NamedFileIn(text), nullptr) << text;
        }
      }
    }
  }
}

TEST(NamedFileIn, SeesFilesOfEveryOtherKind) {
  for (const char* text :
       {"+init=/tmp/canary:x",
        "+init\t=\t/tmp/canary:x",
        "init=canary:x +type=crs",
        "+proj=pipeline +step +proj=utm",
        "+proj = pipeline +step +proj=utm",
        "step +proj=hgridshift",
        "+proj=longlat +proj=vgridshift +type=crs",
        "+proj=tinshift +file=/tmp/canary",
        "+proj=tinshift +file\t=/tmp/canary",
        "+proj=defmodel +model=/tmp/canary",
        "+proj=longlat +catalog=/tmp/canary +type=crs",
        "+proj=longlat +ellps=/tmp/canary +type=crs",
        "+proj=longlat +title=@canary +type=crs",
        "+proj=longlat\v+datum=WGS84",
        "+proj=longlat =/tmp/canary +type=crs",
        "BOUNDCRS[SOURCECRS[],PARAMETERFILE[\"f\",\"/tmp/canary\"]]",
        "BOUNDCRS(SOURCECRS(),ParameterFile (\"f\",\"/tmp/canary\"))",
        "VERT_CS[\"x\",VERT_DATUM[\"x\",2005,EXTENSION[\"PROJ4_GRIDS\",\"egm96_15.gtx\"]]]",
        "GEOGCRS[\"x\",REMARK[\"PROJ CRS string: +init=/tmp/canary:x\"]]",
        "GEOGCRS[\"x\",METHOD[\"PROJ-based operation method: +proj=pipeline +step\"]]",
        R"({"parameters": [{"value": "/tmp/canary"}]})",
        R"({"parameters": [{"value"  :  "/tmp/canary"}]})",
        R"({"parameters": [{"v\u0061lue": "/tmp/canary"}]})",
        R"({"remarks": "PROJ CRS string: +proj=longlat +geoidgrids\t=/tmp/canary"})"}) {
    EXPECT_NE(NamedFileIn(text), nullptr) << text;
  }
  EXPECT_NE(NamedFileIn(std::string_view("EPSG:4326\0x", 11)), nullptr);
}

TEST(NamesFileSomewhere, SeesADefinitionAmongOtherWords) {
  EXPECT_TRUE(
      NamesFileSomewhere("ESRI PE String = GEOGCS[\"x\",EXTENSION[\"PROJ4_GRIDS\",\"/x\"]]|"));
  EXPECT_TRUE(NamesFileSomewhere(std::string_view("a\0+nadgrids = /tmp/canary", 25)));
  EXPECT_FALSE(NamesFileSomewhere(""));
  EXPECT_FALSE(
      NamesFileSomewhere("IMAGINE GeoTIFF Support\nProjection Name = UTM\nUnits = meters|OSGB36 / "
                         "British National Grid|"
                         "+nadgrids=@null +wktext|"));
}

}  // namespace
}  // namespace farhorizon
