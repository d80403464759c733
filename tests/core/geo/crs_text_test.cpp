#include "core/geo/crs_text.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(CheckCrsText, LetsReferenceSystemsPass) {
  for (const char* text :
       {"EPSG:4326", "EPSG:4326+5773", "epsg:32610", "WGS 84", "NAD27 / UTM zone 10N",
        "urn:ogc:def:crs:EPSG::4326", "+proj=utm +zone=10 +datum=WGS84 +type=crs",
        "+proj=merc +a=6378137 +b=6378137 +nadgrids=@null +type=crs",
        "LOCAL_CS[\"x\",UNIT[\"metre\",1]]", "GEOGCRS[\"x\",REMARK[\"see https://example.org\"]]",
        "{\"type\": \"ProjectedCRS\", \"parameters\": [{\"name\": \"x\", \"value\": 0.9996}]}"}) {
    EXPECT_TRUE(CheckCrsText(text)) << text;
  }
}

TEST(CheckCrsText, RefusesNothingAtAll) {
  for (const char* text : {"", "  \n"}) {
    Status checked = CheckCrsText(text);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().kind, "no-crs");
  }
}

TEST(CheckCrsText, RefusesWhateverNamesAFileOrAServer) {
  for (const char* text :
       {"http://example.org/crs.wkt",
        "https://example.org",
        "file:///etc/passwd",
        "/etc/passwd",
        "./crs.wkt",
        "../crs.wkt",
        "~/crs",
        "a\\b",
        "ESRI::../x",
        "+init=epsg:4326",
        "+proj=pipeline +step +proj=utm +zone=10",
        "+proj=longlat +nadgrids=/etc/passwd +type=crs",
        "+proj=longlat +geoidgrids=x.gtx +type=crs",
        "+proj=hgridshift +grids=x",
        "+proj=longlat +nadgrids=@null,x.gsb",
        "+proj=longlat +nadgrids=@null +nadgrids=x.gsb",
        "BOUNDCRS[SOURCECRS[],PARAMETERFILE[\"f\",\"/etc/passwd\"]]",
        "VERT_CS[\"x\",VERT_DATUM[\"x\",2005,EXTENSION[\"PROJ4_GRIDS\",\"/etc/passwd\"]]]",
        "DERIVEDPROJCRS[METHOD[\"PROJ hgridshift grids=/etc/passwd\"]]",
        "{\"type\": \"BoundCRS\", \"parameters\": [{\"value\" : \"/etc/passwd\"}]}",
        "{\"type\": \"BoundCRS\", \"parameters\": [{\"v\\u0061lue\" : \"/etc/passwd\"}]}"}) {
    Status checked = CheckCrsText(text);
    ASSERT_FALSE(checked) << text;
    EXPECT_EQ(checked.error().kind, "unknown-crs") << text;
    EXPECT_EQ(checked.error().code, ErrorCode::kUnsupportedData);
  }
}

TEST(CheckCrsText, NamesTheRemedyOfTheRole) {
  EXPECT_NE(CheckCrsText("./x").error().message.find("--crs"), std::string::npos);
  EXPECT_NE(CheckCrsText("./x", CrsRole::kHeights).error().message.find("EPSG:5773"),
            std::string::npos);
  EXPECT_NE(CheckCrsText(" ", CrsRole::kHeights).error().message.find("EPSG:5773"),
            std::string::npos);
}

TEST(CompletedCrsText, PutsRightWhatPeopleWrite) {
  const std::pair<const char*, const char*> kTexts[] = {
      {"4326", "EPSG:4326"},
      {" EPSG:4326\n", "EPSG:4326"},
      {"epsg:4326", "EPSG:4326"},
      {"EPSG 32613", "EPSG:32613"},
      {"EPSG: 32613", "EPSG:32613"},
      {"EPSG::32613", "EPSG:32613"},
      {"esri:102003", "ESRI:102003"},
      {"EPSG:4326+5773", "EPSG:4326+5773"},
      {"EPSG:4326,EPSG:5773", "EPSG:4326+5773"},
      {"EPSG:4326 5773", "EPSG:4326+5773"},
      {"EPSG:4326 + EPSG:5773", "EPSG:4326+5773"},
      {"ESRI:102003+EPSG:5773", "ESRI:102003+EPSG:5773"},
      {"http://www.opengis.net/def/crs/EPSG/0/4326", "EPSG:4326"},
      {"https://www.opengis.net/def/crs/OGC/1.3/CRS84", "OGC:CRS84"},
      {"+init=epsg:4326", "EPSG:4326"},
      {"init=EPSG:32613 +type=crs", "EPSG:32613"},
      {"+proj=utm +zone=13 +datum=WGS84", "+proj=utm +zone=13 +datum=WGS84 +type=crs"},
      {"+zone=13 +proj=utm", "+zone=13 +proj=utm +type=crs"},
      {"proj=utm zone=13 type=crs", "proj=utm zone=13 type=crs"}};
  for (const auto& [text, complete] : kTexts) EXPECT_EQ(CompletedCrsText(text), complete);
}

TEST(CompletedCrsText, LeavesOthersAsTheyAre) {
  for (const char* text :
       {"", "WGS 84", "NAD27 / UTM zone 10N", "WGS 84 + EGM96 height", "urn:ogc:def:crs:EPSG::4326",
        "GEOGCRS[\"+proj=utm\"]", "+init=/etc/passwd:x"}) {
    EXPECT_EQ(CompletedCrsText(text), text);
  }
}

TEST(CheckCrsText, RefusesNovelsAndShowsOnlyTheirBeginning) {
  Status checked = CheckCrsText(std::string(100'000, 'x'));
  ASSERT_FALSE(checked);
  EXPECT_LT(checked.error().message.size(), 300U);
}

}  // namespace
}  // namespace farhorizon
