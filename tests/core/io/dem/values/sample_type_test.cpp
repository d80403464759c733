#include "core/io/dem/values/sample_type.h"

#include <cmath>

#include "tests/support/dem_fixture.h"

namespace farhorizon {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class SampleTypes : public DemFixture {};

TEST_F(SampleTypes, SignedSamplesOfAnyNumberOfBitsKeepTheirSign) {
  for (const int bits : {4, 7, 8, 9, 12, 15, 16, 17, 24, 31, 32, 64}) {
    const double half = std::min(std::ldexp(1.0, bits - 1), 5000.0);
    const std::vector<double> heights = {-half + 1, -1, 0, 1, half - 2, half - 1};
    const Dem dem = Must(ReadRaw({{.bits = bits, .format = 2, .samples = heights}}));
    EXPECT_EQ(Metres(dem), heights) << bits;
  }
}

TEST_F(SampleTypes, UnsignedSamplesOfAnyNumberOfBitsHaveNone) {
  for (const int bits : {1, 2, 3, 8, 11, 12, 16, 20, 31, 32, 64}) {
    const double most = std::min(std::ldexp(1.0, bits) - 1, 800.0);
    const std::vector<double> heights = {0, 1, most, most, 1, 0};
    for (const int format : {0, 1}) {
      const Dem dem = Must(ReadRaw({{.bits = bits, .format = format, .samples = heights}}));
      EXPECT_EQ(Metres(dem), heights) << bits;
    }
  }
}

TEST_F(SampleTypes, TheNodataTagOfSignedBytesIsSignedToo) {
  const Dem dem = Must(ReadRaw({{.bits = 8,
                                 .format = 2,
                                 .samples = {-128, -5, 0, 5, 100, -128},
                                 .more = {{.tag = 42113, .type = 2, .text = "-128"}}}}));
  EXPECT_EQ(PostsWithoutData(dem), 2);
  EXPECT_EQ(dem.heights[1], -5);
}

TEST_F(SampleTypes, SixteenBitsOfAnUndefinedFormatAreSignedWhereTheirHighestBitIsSet) {
  const std::vector<double> low = {-60, -1, 0, 1, 89, 90};
  const Dem dem = Must(ReadRaw({{.format = 4, .samples = low}}));
  EXPECT_EQ(Metres(dem), low);
  EXPECT_THAT(Codes(dem), Contains("sample-format"));
}

TEST_F(SampleTypes, SixteenBitsOfAnUndefinedFormatWithoutTheirHighestBitAreNothingToSay) {
  const Dem dem = Must(ReadRaw({{.format = 4, .samples = {0, 1, 2, 3, 4, 3000}}}));
  EXPECT_THAT(Codes(dem), Not(Contains("sample-format")));
}

TEST_F(SampleTypes, ANodataTagOfItsUpperHalfDoesNotMakeAnUndefinedFormatSigned) {
  const Dem dem = Must(ReadRaw({{.format = 4,
                                 .samples = {1, 2, 3, 4, 65535, 6},
                                 .more = {{.tag = 42113, .type = 2, .text = "65535"}}}}));
  EXPECT_EQ(dem.heights[4], kNoHeight);
  EXPECT_THAT(Codes(dem), Not(Contains("sample-format")));
}

TEST_F(SampleTypes, BytesOfAnUndefinedFormatAreUnsignedAndSaidToBe) {
  const Dem dem = Must(ReadRaw({{.bits = 8, .format = 4, .samples = {0, 1, 2, 3, 4, 200}}}));
  EXPECT_EQ(dem.heights[5], 200);
  EXPECT_THAT(Codes(dem), Contains("sample-format"));
}

TEST_F(SampleTypes, ContradictoryFormatsAreRefused) {
  const std::vector<double> samples = {0, 1, 2, 3, 4, 5};
  EXPECT_NE(KindOf(ReadRaw({{.bits = 8, .format = 3, .samples = samples}})), "read");
  EXPECT_EQ(KindOf(ReadRaw({{.bits = 32, .format = 4, .samples = samples}})), "unsupported-type");
  EXPECT_NE(KindOf(ReadRaw({{.bits = 32, .format = 5, .samples = samples}})), "read");
  EXPECT_NE(KindOf(ReadRaw({{.bits = 16, .format = 9, .samples = samples}})), "read");
}

TEST_F(SampleTypes, FloatsOfSixteenBitsAreRead) {
  const std::vector<double> heights = {-1.5, 0, 2.25, 100, 500, 1000};
  EXPECT_EQ(Metres(MustRead({.type = "Float32", .values = heights, .options = {"NBITS=16"}})),
            heights);
}

// A half has 11 significant bits: -9999 is stored as -10000.
TEST_F(SampleTypes, ANodataTagMatchesWhatHalfFloatsMakeOfIt) {
  const Dem dem = MustRead({.type = "Float32",
                            .values = {-9999, 1, 2, 3, 4, 5},
                            .nodata = -9999,
                            .options = {"NBITS=16"}});
  EXPECT_EQ(dem.heights[0], kNoHeight);
  EXPECT_THAT(Codes(dem), Not(Contains("untagged-void")));
}

TEST_F(SampleTypes, ANodataTagBeyondHalfFloatsIsInfiniteInThem) {
  const Dem dem = MustRead({.type = "Float32",
                            .values = {-kInfinity, 1, 2, 3, 4, 5},
                            .nodata = -3.4e38,
                            .options = {"NBITS=16"}});
  EXPECT_EQ(dem.heights[0], kNoHeight);
}

TEST_F(SampleTypes, IntegersBeyondDoublesAreRefusedOrVoids) {
  const TestRaster scaled = {.type = "Int64", .values = {1, 2, 1e18, 1.1e18, 5, 6}, .scale = 1e-15};
  const Result<Dem> refused = Read(scaled);
  EXPECT_EQ(KindOf(refused), "height-out-of-range");
  EXPECT_THAT(MessageOf(refused), HasSubstr("gdal_translate -unscale"));
  const Dem dem = MustRead({.type = "UInt64", .values = {1, 2, 18446744073709549568.0, 4, 5, 6}});
  EXPECT_THAT(Codes(dem), Contains("untagged-void"));
}

TEST_F(SampleTypes, ComplexNumbersAreRefusedWithWhatTakesTheirRealPart) {
  const Result<Dem> dem = Read({.type = "CFloat32"});
  EXPECT_EQ(KindOf(dem), "unsupported-type");
  EXPECT_THAT(MessageOf(dem), HasSubstr("gdal_translate -ot Float64"));
}

TEST(SampleType, RoundsAsItIsStored) {
  SampleType half;
  half.is_float = true;
  half.significant_bits = 11;
  half.greatest = 65504;
  EXPECT_EQ(half.AsStored(-9999), -10000);
  EXPECT_EQ(half.AsStored(0.5), 0.5);
  EXPECT_EQ(half.AsStored(-1e5), -std::numeric_limits<double>::infinity());
  SampleType bytes;
  bytes.least = 0;
  bytes.greatest = 255;
  EXPECT_EQ(bytes.AsStored(255), 255);
  EXPECT_TRUE(std::isnan(bytes.AsStored(-1)));
  EXPECT_TRUE(std::isnan(bytes.AsStored(0.5)));
}

}  // namespace
}  // namespace farhorizon
