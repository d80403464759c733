#include "core/geo/crs_text.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(CheckCrsText, LetsReferenceSystemsPass) {
  for (const char* text :
       {"EPSG:4326", "EPSG:4326+5773", "epsg:32610", "WGS 84", "NAD27 / UTM zone 10N",
        "urn:ogc:def:crs:EPSG::4326", "+proj=utm +zone=10 +datum=WGS84 +type=crs",
        "+proj=merc +a=6378137 +b=6378137 +nadgrids=@null +type=crs",
        "LOCAL_CS[\"x\",UNIT[\"metre\",1]]",
        "GEOGCRS[\"x\",REMARK[\"see https://example.org\"]]"}) {
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
       {"http://example.org/crs.wkt", "https://example.org", "file:///etc/passwd", "/etc/passwd",
        "./crs.wkt", "../crs.wkt", "~/crs", "a\\b", "ESRI::../x", "+init=epsg:4326",
        "+proj=pipeline +step +proj=utm +zone=10", "+proj=longlat +nadgrids=/etc/passwd +type=crs",
        "+proj=longlat +geoidgrids=x.gtx +type=crs", "+proj=hgridshift +grids=x",
        "+proj=longlat +nadgrids=@null,x.gsb +nadgrids=x.gsb",
        "BOUNDCRS[SOURCECRS[],PARAMETERFILE[\"f\",\"/etc/passwd\"]]"}) {
    Status checked = CheckCrsText(text);
    ASSERT_FALSE(checked) << text;
    EXPECT_EQ(checked.error().kind, "unknown-crs") << text;
    EXPECT_EQ(checked.error().code, ErrorCode::kUnsupportedData);
  }
}

TEST(CheckCrsText, RefusesNovelsAndShowsOnlyTheirBeginning) {
  Status checked = CheckCrsText(std::string(100'000, 'x'));
  ASSERT_FALSE(checked);
  EXPECT_LT(checked.error().message.size(), 300U);
}

}  // namespace
}  // namespace farhorizon
