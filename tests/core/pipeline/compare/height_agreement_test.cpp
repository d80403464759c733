#include "core/pipeline/compare/height_agreement.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/placed_dem.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;

// What CheckHeights says of a mesh with the heights `of(dem height, post)`.
template <typename Of>
std::string Said(const PlacedDem& dem, Of of) {
  std::vector<double> heights;
  for (VertexId v = 0; v < PlacedDem::kColumns * PlacedDem::kRows; ++v) {
    heights.push_back(of(dem.input().dem().HeightM(v), v));
  }
  const Status lies = CheckHeights(CompareHeights(heights, dem.input().dem()), dem.input());
  return lies ? "" : lies.error().message;
}

TEST(CheckHeights, TakesErrorsOfAnySizeThatScatter) {
  const PlacedDem dem;
  EXPECT_EQ(Said(dem, [](double h, VertexId) { return h; }), "");
  EXPECT_EQ(Said(dem, [](double h, VertexId) { return h + 0.9; }), "");
  EXPECT_EQ(Said(dem, [](double h, VertexId v) { return h + 3 + v * 7919 % 41; }), "");
  EXPECT_EQ(Said(dem, [](double, VertexId v) { return 800.0 + v * 7919 % 400; }), "")
      << "noise has no slope to judge by";
  EXPECT_EQ(Said(dem, [](double h, VertexId v) { return v < 300 ? h : std::nan(""); }), "");
}

TEST(CheckHeights, SaysTheMeasuredOffset) {
  const PlacedDem dem;
  const std::string said = Said(dem, [](double h, VertexId v) { return h - 34.25 + v % 2; });
  EXPECT_THAT(said, HasSubstr("33.25 m below the DEM's"));
  EXPECT_THAT(said, HasSubstr("--mesh-height-offset 33.25"));
  EXPECT_THAT(said, HasSubstr("--vertical-datum"));
  EXPECT_THAT(Said(dem, [](double h, VertexId) { return h + 55; }), HasSubstr("55 m above"));
}

TEST(CheckHeights, KnowsFeetAndWhatIsUpsideDownAndExaggerated) {
  const PlacedDem dem;
  EXPECT_THAT(Said(dem, [](double h, VertexId) { return h / 0.3048; }),
              HasSubstr("look like feet"));
  EXPECT_THAT(Said(dem, [](double h, VertexId) { return h * 0.3048; }),
              HasSubstr("a DEM that is in feet"));
  EXPECT_THAT(Said(dem, [](double h, VertexId) { return -h; }), HasSubstr("upside down"));
  EXPECT_THAT(Said(dem, [](double h, VertexId) { return 1.5 * h; }), HasSubstr("rises by 1.5"));
}

TEST(CheckHeights, HasNothingToSayOfSlopesOnLevelGround) {
  const PlacedDem sea([](int, int) { return 0; });
  EXPECT_EQ(Said(sea, [](double, VertexId v) { return v % 3 * 0.1; }), "");
  EXPECT_THAT(Said(sea, [](double, VertexId) { return 47.0; }), HasSubstr("47 m above"));
}

}  // namespace
}  // namespace farhorizon
