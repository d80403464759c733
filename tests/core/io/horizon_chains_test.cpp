#include "core/io/horizon_chains.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using ::testing::ElementsAre;
using Post = std::array<std::int32_t, 2>;

Geodetic PlaceOfPoint(const Post& p, double first_lon) {
  double lon = first_lon + 0.001 * p[0];
  if (lon > 180) lon -= 360;
  return {lon, 46 - 0.001 * p[1], 500.0 + p[0]};
}

HorizonFeature EdgeOf(const Post& a, const Post& b, double first_lon = 7) {
  HorizonFeature f{};
  f.a = a;
  f.b = b;
  f.from = PlaceOfPoint(a, first_lon);
  f.to = PlaceOfPoint(b, first_lon);
  f.measures = {.azimuths = {{0, 1}}, .line_measure_m = 2, .skyline_drop_m = 0.5};
  return f;
}

// A cross at (1, 1) of a row and a column, and an edge aside.
std::vector<HorizonFeature> CrossProduct() {
  return {EdgeOf({0, 1}, {1, 1}), EdgeOf({1, 0}, {1, 1}), EdgeOf({1, 1}, {2, 1}),
          EdgeOf({1, 1}, {1, 2}), EdgeOf({5, 5}, {6, 6})};
}

TEST(ChainsOf, StraightestEdgesAreJoined) {
  const std::vector<HorizonChain> chains = ChainsOf(CrossProduct());
  ASSERT_EQ(chains.size(), 3U);
  EXPECT_THAT(chains[0].posts, ElementsAre(Post{0, 1}, Post{1, 1}, Post{2, 1}));
  EXPECT_THAT(chains[1].posts, ElementsAre(Post{1, 0}, Post{1, 1}, Post{1, 2}));
  EXPECT_THAT(chains[2].posts, ElementsAre(Post{5, 5}, Post{6, 6}));
}

TEST(ChainsOf, WeightsAreThoseOfAllEdges) {
  std::vector<HorizonFeature> edges = CrossProduct();
  edges[2].measures = {.azimuths = {{90, 91}}, .line_measure_m = 3, .skyline_drop_m = 4};
  edges[2].level_kept = 3;
  const HorizonChain chain = ChainsOf(edges).front();
  EXPECT_EQ(chain.azimuths, 1U | AzimuthMask{1} << 32U);
  EXPECT_EQ(chain.line_measure_m, 5);
  EXPECT_EQ(chain.skyline_drop_m, 4);
  EXPECT_THAT(chain.level_kept, ElementsAre(std::nullopt, std::optional(3)));
  edges[0].measures.drop = Known::kNotAfforded;
  EXPECT_EQ(ChainsOf(edges).front().drop, Known::kNotAfforded);
  EXPECT_EQ(ChainsOf(edges).front().sights, Known::kYes);
}

TEST(ChainsOf, ARingIsOneChainAndEveryEdgeComesOnce) {
  const std::vector<HorizonFeature> ring = {EdgeOf({0, 0}, {1, 0}), EdgeOf({0, 0}, {1, 1}),
                                            EdgeOf({1, 0}, {1, 1})};
  const std::vector<HorizonChain> chains = ChainsOf(ring);
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains[0].posts.size(), 4U);
  EXPECT_EQ(chains[0].posts.front(), chains[0].posts.back());
}

TEST(ChainsOf, UndecidedEdgesAreNotJoinedToOthers) {
  std::vector<HorizonFeature> edges = CrossProduct();
  edges[0].undecided = true;
  edges[0].measures = {.sights = Known::kNotAfforded, .drop = Known::kNotAfforded};
  std::size_t undecided = 0;
  for (const HorizonChain& chain : ChainsOf(edges)) {
    if (chain.undecided) undecided += chain.level_kept.size();
  }
  EXPECT_EQ(undecided, 1U);
}

TEST(HorizonChains, ReadsBackWhatItWrote) {
  std::vector<HorizonFeature> edges = CrossProduct();
  edges[0].level_kept = 11;
  edges[4].undecided = true;
  edges[3].measures.sights = Known::kNotAfforded;
  const std::vector<HorizonChain> chains = ChainsOf(edges);
  const std::string text = WriteHorizonChains(chains, 100);
  EXPECT_TRUE(HasChains(text));
  EXPECT_FALSE(HasChains(WriteHorizonGeoJson(edges)));
  Result<std::vector<HorizonChain>> read = ReadHorizonChains(text);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), chains.size());
  for (std::size_t i = 0; i < chains.size(); ++i) {
    EXPECT_EQ((*read)[i].level_kept, chains[i].level_kept);
    EXPECT_EQ((*read)[i].undecided, chains[i].undecided);
    ASSERT_EQ((*read)[i].line.size(), chains[i].line.size());
    EXPECT_NEAR((*read)[i].line[0].lon_deg, chains[i].line[0].lon_deg, 1e-5);
  }
  EXPECT_EQ((*read)[0].azimuths, chains[0].azimuths);
  EXPECT_EQ((*read)[0].line_measure_m, 4);
  EXPECT_EQ((*read)[1].sights, Known::kNotAfforded);
  EXPECT_NE(text.find(R"("edges":5,"azimuths":"0000000000000001")"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("levels_kept":"b-")"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("approximate":true,"undecided":1)"), std::string::npos) << text;
}

TEST(HorizonChains, AreCutAtTheMeridianOf180Degrees) {
  const std::vector<HorizonFeature> edges = {EdgeOf({0, 0}, {1, 0}, 179.9995),
                                             EdgeOf({1, 0}, {2, 1}, 179.9995)};
  const std::vector<HorizonChain> chains = ChainsOf(edges);
  const std::string text = WriteHorizonChains(chains, 80);
  EXPECT_NE(text.find("MultiLineString"), std::string::npos) << text;
  const HorizonChain read = ReadHorizonChains(text)->front();
  ASSERT_EQ(read.line.size(), 3U);
  EXPECT_GT(read.line[0].lon_deg, 179.9);
  EXPECT_LT(read.line[1].lon_deg, -179.9);
  EXPECT_LT(read.line[2].lon_deg, -179.9);
}

TEST(HorizonChains, AreRoundedToAPartOfACell) {
  EXPECT_EQ(RoundingOfChains(90).degree_decimals, 5);
  EXPECT_EQ(RoundingOfChains(90).metre_decimals, 0);
  EXPECT_EQ(RoundingOfChains(1).degree_decimals, 7);
  EXPECT_EQ(RoundingOfChains(1).metre_decimals, 2);
  EXPECT_EQ(RoundingOfChains(1e-9).degree_decimals, 9);
}

TEST(HorizonChains, OtherTextIsAnErrorWithTheFeature) {
  std::vector<HorizonFeature> edges = CrossProduct();
  edges[0].level_kept = 3;
  const std::string text = WriteHorizonChains(ChainsOf(edges), 30);
  const auto changed = [&text](const std::string& what, const std::string& with) {
    std::string other = text;
    other.replace(other.find(what), what.size(), with);
    Result<std::vector<HorizonChain>> read = ReadHorizonChains(other);
    return read ? "" : read.error().message;
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(changed(R"("levels_kept":"3-")", R"("levels_kept":"3")"), HasSubstr("feature 0"));
  EXPECT_THAT(changed(R"("coordinates":[[7.001,46,)", R"("coordinates":[["7",46,)"),
              HasSubstr("feature 1"));
  EXPECT_THAT(changed("LineString", "PolyString"), HasSubstr("feature 0"));
  EXPECT_FALSE(ReadHorizonChains("{}"));
  EXPECT_FALSE(ReadHorizonChains(text.substr(0, text.size() / 2)));
}

}  // namespace
}  // namespace farhorizon
