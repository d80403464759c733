#include "core/io/dem/values/nodata_rule.h"

#include "tests/support/dem_fixture.h"

namespace farhorizon {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class NoDataRules : public DemFixture {
 protected:
  Dem WithTag(const std::string& text, int format = 2) {
    return Must(ReadRaw({{.format = format,
                          .samples = {1, 2, 3, 0, 5, 6},
                          .more = {{.tag = 42113, .type = 2, .text = text}}}}));
  }
};

TEST_F(NoDataRules, ValuesOfTheCallAddToTheFiles) {
  const Dem dem = MustRead({.nodata = 1}, {.nodata = {2, 5}});
  EXPECT_THAT(dem.heights, ElementsAre(kNoHeight, kNoHeight, 3, 4, kNoHeight, 6));
}

TEST_F(NoDataRules, InfinitiesAndNanCanBeNamed) {
  const TestRaster infinite = {.type = "Float32", .values = {-kInfinity, 2, kInfinity, 4, kNan, 6}};
  const Dem dem = MustRead(infinite, {.nodata = {-kInfinity, kInfinity, kNan}});
  EXPECT_THAT(dem.heights, ElementsAre(kNoHeight, 2, kNoHeight, 4, kNoHeight, 6));
  const Result<Dem> one = Read(infinite, {.nodata = {-kInfinity}});
  EXPECT_EQ(KindOf(one), "infinite-height");
  EXPECT_THAT(MessageOf(one), HasSubstr("--nodata=inf"));
  EXPECT_THAT(MessageOf(Read(infinite)), HasSubstr("--nodata=-inf"));
}

TEST_F(NoDataRules, TagsAreNumbersInManyWordings) {
  for (const char* text : {"0", " 0 ", "0.0", "-0", "+0", "0e5", "0,0"}) {
    EXPECT_EQ(PostsWithoutData(WithTag(text)), 1) << text;
  }
  EXPECT_EQ(PostsWithoutData(WithTag("1 2")), 2);
  EXPECT_EQ(PostsWithoutData(WithTag("")), 0);
}

// GDAL takes them for 0 and makes holes of the sea.
TEST_F(NoDataRules, ATagThatIsNoNumberHidesNothingAndIsSaid) {
  for (const char* text : {"none", "NA", "-", "9-9", "\x01\x02"}) {
    const Dem dem = WithTag(text);
    EXPECT_EQ(PostsWithoutData(dem), 0) << text;
    EXPECT_THAT(Codes(dem), Contains("nodata-tag")) << text;
  }
}

TEST_F(NoDataRules, ATagThatNoSampleCanHaveIsSaid) {
  for (const char* text : {"-9999", "70000", "1.5", "nan", "-3.4028234663852886e+38"}) {
    const Dem dem = WithTag(text, 1);
    EXPECT_EQ(PostsWithoutData(dem), 0) << text;
    EXPECT_THAT(Codes(dem), Contains("nodata-tag")) << text;
  }
  EXPECT_THAT(Codes(WithTag("65535", 1)), Not(Contains("nodata-tag")));
  EXPECT_THAT(Codes(WithTag("-32768", 2)), Not(Contains("nodata-tag")));
}

TEST_F(NoDataRules, FloatsThatBecameDoublesMatchTheirTag) {
  const Dem dem = MustRead({.type = "Float64",
                            .values = {static_cast<double>(-9999.9F), 2, 3, 4, 5, 6},
                            .nodata = -9999.9});
  EXPECT_EQ(dem.heights[0], kNoHeight);
  EXPECT_THAT(Codes(dem), Not(Contains("untagged-void")));
}

}  // namespace
}  // namespace farhorizon
