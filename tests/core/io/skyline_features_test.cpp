#include "core/io/skyline_features.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

SkylineFeature Part(double left, double right, double depth, double height) {
  return {{1, 2},         {2, 2},        {7, 46, height}, {7.5, 46, height + 10},
          {0.1, 2.0 / 3}, {left, right}, {depth, depth}};
}

SkylineOfDirection SomeSkyline() {
  return {30,
          {4194304, -77},
          false,
          {Part(-200, -50, 10, 500), Part(-50, 0, 900, 480), Part(100, 200, 0, 510)}};
}

TEST(SkylineGeoJson, SaysEachPartOnceAndItsEndsWithoutLoss) {
  const json skyline = json::parse(WriteSkylineGeoJson(SomeSkyline()));
  EXPECT_EQ(skyline["azimuth"], 30);
  EXPECT_EQ(skyline["direction"], json::parse("[4194304,-77]"));
  EXPECT_FALSE(skyline.contains("approximate"));
  ASSERT_EQ(skyline["features"].size(), 3U);
  const json& part = skyline["features"][1];
  EXPECT_EQ(part["geometry"]["coordinates"], json::parse("[[7,46,480],[7.5,46,490]]"));
  EXPECT_EQ(part["properties"]["t"][1].get<double>(), 2.0 / 3);
  EXPECT_EQ(part["properties"]["offset_m"], json::parse("[-50,0]"));
}

TEST(SkylineGeoJson, OfASupersetSaysSo) {
  SkylineOfDirection skyline = SomeSkyline();
  skyline.approximate = true;
  EXPECT_EQ(json::parse(WriteSkylineGeoJson(skyline))["approximate"], true);
}

TEST(SkylinePicture, FillsTheGroundUnderEachRunOfPartsAndShadesThemByDepth) {
  const std::string svg = DrawSkyline(SomeSkyline(), "a <title> & more");
  EXPECT_THAT(svg, HasSubstr("a &lt;title> &amp; more: 3 parts of horizon edges"));
  const std::size_t at = svg.find("class=\"ground\"");
  const std::string ground = svg.substr(at, svg.find("/>", at) - at);
  EXPECT_EQ(std::count(ground.begin(), ground.end(), 'M'), 2) << "a gap from 0 to 100";
  EXPECT_EQ(std::count(ground.begin(), ground.end(), 'Z'), 2);
  EXPECT_THAT(svg, HasSubstr("depth4\" d=\"M"));
  EXPECT_THAT(svg, HasSubstr("depth0\" d=\"M"));
  EXPECT_THAT(svg, HasSubstr("depth2\" d=\"\""));
}

TEST(SkylinePicture, OfLevelGroundHasAScale) {
  const SkylineOfDirection level = {
      0, {1, 0}, false, {{{0, 0}, {1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1}, {0, 30}, {0, 0}}}};
  const std::string svg = DrawSkyline(level, "level");
  EXPECT_THAT(svg, HasSubstr(": 1 part of"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

}  // namespace
}  // namespace farhorizon
