// What the fuzz target does with its bytes, without libFuzzer: any compiler runs it.
#include "tests/fuzz/dem_from_bytes.h"

#include <cstdlib>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/engine_agreement.h"

namespace farhorizon {
namespace {

std::vector<std::uint8_t> AnyBytes(std::mt19937& random) {
  std::vector<std::uint8_t> bytes(random() % 425);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

TEST(DemFromBytes, MakesADemWithinTheLimitsOfAnyBytes) {
  std::mt19937 random(1);
  std::int32_t highest = 0;
  int holes = 0;
  for (int round = 0; round < Rounds(5'000); ++round) {
    const Dem dem = DemFromBytes(AnyBytes(random));
    ASSERT_TRUE(dem.columns >= 2 && dem.columns <= 9 && dem.rows >= 2 && dem.rows <= 9);
    ASSERT_EQ(dem.heights.size(), static_cast<std::size_t>(dem.columns * dem.rows));
    for (const std::int32_t h : dem.heights) {
      holes += h == kNoHeight ? 1 : 0;
      if (h == kNoHeight) continue;
      ASSERT_LT(std::abs(h), 1 << 30);
      highest = std::max(highest, std::abs(h));
    }
  }
  EXPECT_GT(highest, 1 << 29) << "and goes to them";
  EXPECT_GT(holes, 0);
}

TEST(DemFromBytes, ReadsMissingBytesAsZero) {
  EXPECT_EQ(DrawAscii(DemFromBytes({})), "0 0\n0 0\n");
  const std::vector<std::uint8_t> bytes = {1, 0, 1, 0, 7, 255, 9};
  EXPECT_EQ(DrawAscii(DemFromBytes(bytes)), "7 . 9\n0 0 0\n");
}

TEST(HorizonFuzz, FindsNoOffenceOnRandomBytes) {
  std::mt19937 random(2);
  for (int round = 0; round < Rounds(400); ++round) {
    const Dem dem = DemFromBytes(AnyBytes(random));
    ASSERT_EQ(EngineOffence(dem, {.posts_by_definition = 20}), "") << DrawAscii(dem);
  }
}

}  // namespace
}  // namespace farhorizon
