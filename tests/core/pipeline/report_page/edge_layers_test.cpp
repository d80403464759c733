#include "core/pipeline/report_page/edge_layers.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/metre_steps.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

HorizonFeature Seen(std::array<std::int32_t, 2> a, std::array<std::int32_t, 2> b, double from,
                    double to) {
  HorizonFeature edge{};
  edge.a = a;
  edge.b = b;
  edge.measures.azimuths = {{from, to}};
  edge.measures.line_measure_m = to - from;
  return edge;
}

std::size_t Drawn(const EdgeLayer& layer) {
  return layer.picture.values.size() -
         static_cast<std::size_t>(std::ranges::count(layer.picture.values, 0));
}

TEST(AzimuthColours, GoRoundInHalfATurn) {
  EXPECT_EQ(ColourOfAzimuth(0), ColourOfAzimuth(180));
  EXPECT_EQ(ColourOfAzimuth(-10), ColourOfAzimuth(350));
  EXPECT_EQ(HexOf(ColourOfAzimuth(0)), "#0072b2");
  // No two directions that are well apart look alike, nor do neighbours jump.
  const auto distance = [](const Colour& a, const Colour& b) {
    int most = 0;
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
  };
  for (int a = 0; a < 180; ++a) {
    EXPECT_LT(distance(ColourOfAzimuth(a), ColourOfAzimuth(a + 1)), 40) << a;
    for (int turn = 36; turn <= 90; ++turn) {
      EXPECT_GT(distance(ColourOfAzimuth(a), ColourOfAzimuth(a + turn)), 40) << a << " " << turn;
    }
  }
}

TEST(AzimuthColours, SectorsAreAboutThePointsOfTheCompass) {
  for (const auto& [azimuth, sector] : std::vector<std::pair<double, int>>{{0, 0},
                                                                           {22, 0},
                                                                           {23, 1},
                                                                           {67, 1},
                                                                           {68, 2},
                                                                           {112, 2},
                                                                           {113, 3},
                                                                           {157, 3},
                                                                           {158, 0},
                                                                           {180, 0},
                                                                           {225, 1}}) {
    EXPECT_EQ(SectorOfAzimuth(azimuth), sector) << azimuth;
  }
}

TEST(AzimuthColours, ShowTheWidestInterval) {
  EXPECT_EQ(ShownAzimuth({{10, 20}, {50, 90}, {100, 110}}), 70);
  EXPECT_EQ(ShownAzimuth({{10, 20}, {30, 40}}), 15) << "the first of equal ones";
  EXPECT_EQ(ShownAzimuth({{170, 210}}), 10) << "a middle beyond the half turn";
  EXPECT_EQ(ShownAzimuth({{0, 180}}), 90);
}

TEST(DrawEdgeLayers, EachEdgeIsInOneLayer) {
  const Dem dem = MakeDem(9, 9, [](auto, auto) { return 0; });
  HorizonFeature undecided{};
  undecided.a = {8, 0};
  undecided.b = {8, 1};
  undecided.undecided = true;
  const std::vector<HorizonFeature> features = {
      Seen({0, 0}, {1, 1}, 0, 10), Seen({0, 8}, {1, 8}, 40, 60), Seen({4, 4}, {4, 5}, 80, 90),
      Seen({5, 4}, {5, 5}, 85, 100), undecided};
  const auto layers = DrawEdgeLayers(features, FrameOf(dem, kMetreSteps));
  const std::array<std::int64_t, 5> counts = {1, 1, 2, 0, 1};
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_EQ(layers[i].edges, counts[i]) << i;
    EXPECT_EQ(Drawn(layers[i]) > 0, counts[i] > 0) << i;
    EXPECT_EQ(layers[i].picture.palette.front()[3], 0) << "nothing is clear";
  }
  EXPECT_EQ(layers[2].line_measure_m, 25);
}

TEST(DrawEdgeLayers, HaveTheFramesSizeHoweverManyEdges) {
  const Dem dem = MakeDem(2000, 3, [](auto, auto) { return 0; });
  std::vector<HorizonFeature> features;
  for (std::int32_t c = 0; c + 1 < dem.columns; ++c) {
    for (std::int32_t r = 0; r < 3; ++r) features.push_back(Seen({c, r}, {c + 1, r}, c % 180, 181));
  }
  const PictureFrame frame = FrameOf(dem, kMetreSteps);
  const auto layers = DrawEdgeLayers(features, frame);
  std::int64_t edges = 0;
  for (const EdgeLayer& layer : layers) {
    edges += layer.edges;
    EXPECT_EQ(layer.picture.values.size(), static_cast<std::size_t>(frame.width * frame.height));
  }
  EXPECT_EQ(edges, static_cast<std::int64_t>(features.size()));
}

TEST(DrawEdgeLayers, ADemWithoutHorizonEdgesHasEmptyLayers) {
  const Dem dem = MakeDem(3, 3, [](auto, auto) { return 0; });
  for (const EdgeLayer& layer : DrawEdgeLayers({}, FrameOf(dem, kMetreSteps))) {
    EXPECT_EQ(layer.edges, 0);
    EXPECT_EQ(Drawn(layer), 0U);
  }
}

}  // namespace
}  // namespace farhorizon
