#include "core/io/compare_svg.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using testing::HasSubstr;
using testing::Not;

const double kNone = std::nan("");

ComparisonPicture Small() {
  ComparisonPicture picture;
  picture.title = "a <mesh> & a DEM";
  picture.lines = {"12 triangles"};
  picture.skylines = {{90, {-10, 0, 10, 20}, {5, 9, 9, kNone}, {5, 7, 10, kNone}}};
  picture.map = {3, 2, {0, -1, 1, kNone, -4, 4}, 1};
  return picture;
}

TEST(DrawComparisonSvg, HasBothSkylinesTheirDifferenceAndTheMap) {
  const std::string svg = DrawComparisonSvg(Small());
  EXPECT_THAT(svg, testing::StartsWith("<svg "));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
  EXPECT_THAT(svg, HasSubstr("a &lt;mesh> &amp; a DEM"));
  EXPECT_THAT(svg, HasSubstr("towards 90 degrees, 30 m wide"));
  for (const char* part : {"\"demline\"", "\"mesh\"", "\"above\"", "\"below\"", "\"map\""}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
  // The greatest difference is 2 m; the map's darkest colours are those of -4 and 4.
  EXPECT_THAT(svg, HasSubstr(">+2 m<"));
  EXPECT_THAT(svg, HasSubstr("stroke=\"#16437e\""));
  EXPECT_THAT(svg, HasSubstr("stroke=\"#8f1d1d\""));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(DrawComparisonSvg, DrawsWhatIsLevelEmptyOrTheSame) {
  ComparisonPicture picture = Small();
  picture.skylines[0].dem_m = {3, 3, 3, 3};
  picture.skylines[0].mesh_m = {3, 3, 3, 3};
  picture.skylines.push_back({0, {0, 1}, {kNone, kNone}, {kNone, kNone}});
  picture.map = {2, 1, {kNone, kNone}, 1};
  const std::string svg = DrawComparisonSvg(picture);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_THAT(svg, HasSubstr("nothing is seen in this direction"));
  EXPECT_THAT(svg, Not(HasSubstr("times more"))) << "no difference, nothing to enlarge";
}

}  // namespace
}  // namespace farhorizon
