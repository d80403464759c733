#include "core/io/skyline_svg.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/published.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;
using testing::Not;

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
