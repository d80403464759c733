#include "core/io/dem/values/untagged_voids.h"

#include <limits>

#include "tests/support/dem_fixture.h"

namespace farhorizon {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class UntaggedVoids : public DemFixture {
 protected:
  // Heights of a raster in which `value` stands where no data is.
  TestRaster WithVoid(const std::string& type, double value) {
    return {.type = type, .values = {201, value, 203, 204, value, 206}};
  }
  void ExpectLeftOut(const TestRaster& raster, const std::string& named) {
    const Dem dem = MustRead(raster);
    EXPECT_EQ(PostsWithoutData(dem), 2) << raster.type << " " << named;
    ASSERT_THAT(Codes(dem), Contains("untagged-void")) << raster.type << " " << named;
    for (const Assumption& a : dem.assumptions) {
      if (a.code != "untagged-void") continue;
      EXPECT_THAT(a.text, HasSubstr("2 posts of " + named));
      EXPECT_THAT(a.text, HasSubstr("--nodata=" + named));
    }
  }
};

TEST_F(UntaggedVoids, OfEveryTypeAreLeftOutAndSaid) {
  ExpectLeftOut(WithVoid("Int16", -32768), "-32768");
  ExpectLeftOut(WithVoid("Int16", -32767), "-32767");
  ExpectLeftOut(WithVoid("Int16", 32767), "32767");
  ExpectLeftOut(WithVoid("Int16", -9999), "-9999");
  ExpectLeftOut(WithVoid("Int16", 9999), "9999");
  ExpectLeftOut(WithVoid("UInt16", 65535), "65535");
  ExpectLeftOut(WithVoid("Int32", -99999), "-99999");
  ExpectLeftOut(WithVoid("Int32", -2147483648.0), "-2147483648");
  ExpectLeftOut(WithVoid("Int32", 2147483647.0), "2147483647");
  ExpectLeftOut(WithVoid("UInt32", 4294967295.0), "4294967295");
  ExpectLeftOut(WithVoid("Float32", -9999), "-9999");
  ExpectLeftOut(WithVoid("Float32", static_cast<double>(-9999.9F)), "-9999.9");
  ExpectLeftOut(WithVoid("Float32", -32768), "-32768");
  ExpectLeftOut(WithVoid("Float32", 1e20F), "1e+20");
  ExpectLeftOut(WithVoid("Float32", -std::numeric_limits<float>::max()), "-3.4028235e+38");
  ExpectLeftOut(WithVoid("Float32", 1e30F), "1e+30");
  ExpectLeftOut(WithVoid("Float64", -std::numeric_limits<double>::max()),
                "-1.7976931348623157e+308");
}

TEST_F(UntaggedVoids, AreNoAssumptionOnceTheyAreNamed) {
  const Dem dem = MustRead(WithVoid("Int16", -32768), {.nodata = {-32768}});
  EXPECT_EQ(PostsWithoutData(dem), 2);
  EXPECT_THAT(Codes(dem), Not(Contains("untagged-void")));
  const Dem wide = MustRead(WithVoid("Float32", -std::numeric_limits<float>::max()),
                            {.nodata = {-3.4028235e+38}});
  EXPECT_THAT(Codes(wide), Not(Contains("untagged-void")));
}

TEST_F(UntaggedVoids, BesideATagAreLeftOutToo) {
  const Dem dem = MustRead({.values = {-9999, -32767, 203, 204, 205, 206}, .nodata = -9999});
  EXPECT_EQ(PostsWithoutData(dem), 2);
  EXPECT_THAT(Codes(dem), Contains("untagged-void"));
}

TEST_F(UntaggedVoids, NumberedOnAreOneFamily) {
  const Dem dem = MustRead({.values = {-9999, -9998, 203, 204, 205, 206}});
  EXPECT_EQ(PostsWithoutData(dem), 2);
  EXPECT_THAT(dem.assumptions.front().text + dem.assumptions.back().text,
              HasSubstr("--nodata=-9999 --nodata=-9998"));
}

// -32768 feet are -9988 m, which some ground has: but none so far from all other ground.
TEST_F(UntaggedVoids, InFeetAreSeenByTheirDistanceFromOtherHeights) {
  TestRaster feet = WithVoid("Int16", -32768);
  feet.unit = "ft";
  EXPECT_EQ(PostsWithoutData(MustRead(feet)), 2);
}

TEST_F(UntaggedVoids, TheDeepestGroundIsKept) {
  const Dem trench = MustRead({.values = {-9000, -9800, -9998, -9999, -10000, -10935}});
  EXPECT_THAT(Metres(trench), ElementsAre(-9000, -9800, -9998, -9999, -10000, -10935));
  EXPECT_THAT(Codes(trench), Not(Contains("untagged-void")));
  const Dem summit = MustRead({.values = {8000, 8100, 8300, 8500, 8700, 8849}});
  EXPECT_EQ(PostsWithoutData(summit), 0);
}

TEST_F(UntaggedVoids, OrdinaryHeightsThatAreRoundNumbersAreKept) {
  EXPECT_EQ(PostsWithoutData(MustRead({.values = {999, 0, -999, 1000, 400, 255}})), 0);
  EXPECT_EQ(PostsWithoutData(MustRead({.type = "Byte", .values = {255, 0, 255, 255, 0, 1}})), 0);
  EXPECT_EQ(PostsWithoutData(MustRead({.values = {999, 999, 999, 999, 999, 999}})), 0);
}

TEST_F(UntaggedVoids, OtherValuesBeyondGroundAreRefusedWithTheirRemedies) {
  for (const double value : {-12000.0, -11501.0, 9600.0, 30000.0, -20000.0}) {
    const Result<Dem> dem = Read({.values = {1, 2, 3, value, 5, 6}});
    EXPECT_EQ(KindOf(dem), "height-out-of-range") << value;
    const std::string text = std::to_string(static_cast<int>(value));
    EXPECT_THAT(MessageOf(dem), HasSubstr("column 0, row 1 is " + text));
    EXPECT_THAT(MessageOf(dem), HasSubstr("--nodata=" + text));
    EXPECT_THAT(MessageOf(dem), HasSubstr("--height-unit"));
    EXPECT_THAT(MessageOf(dem), HasSubstr("gdal_translate -a_scale"));
    EXPECT_EQ(KindOfTiff({.values = {1, 2, 3, value, 5, 6}}, {.nodata = {value}}), "read");
  }
}

TEST_F(UntaggedVoids, AreJudgedInMetres) {
  EXPECT_EQ(KindOfTiff({.values = {10000, 14000, 20000, 12000, 13000, 28000}}),
            "height-out-of-range");
  EXPECT_EQ(KindOfTiff({.values = {10000, 14000, 20000, 12000, 13000, 28000}, .unit = "ft"}),
            "read");
  EXPECT_EQ(KindOfTiff({.values = {10000, 14000, 20000, 12000, 13000, 28000}, .scale = 0.01}),
            "read");
  EXPECT_EQ(KindOfTiff({.values = {10, 14, 20, 12, 13, 28}, .scale = 1000}), "height-out-of-range");
}

TEST_F(UntaggedVoids, UnsignedSamplesThatWrapAreSaidToBe) {
  EXPECT_THAT(MessageOf(Read({.type = "UInt16", .values = {65476, 65500, 3, 4, 5, 6}})),
              HasSubstr("A.astype('int16')"));
}

TEST_F(UntaggedVoids, ManyHugeValuesAreNoVoids) {
  std::vector<double> values(400);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1e12 * static_cast<double>(i + 1);
  EXPECT_EQ(KindOfTiff({.columns = 20, .rows = 20, .type = "Float64", .values = values}),
            "height-out-of-range");
}

TEST_F(UntaggedVoids, ARasterOfNothingElseHasNoData) {
  EXPECT_EQ(KindOfTiff({.values = std::vector<double>(6, -32768)}), "all-nodata");
}

}  // namespace
}  // namespace farhorizon
