#include "core/io/sweep_svg.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using testing::HasSubstr;

SweepTrace SomeTrace() {
  SweepTrace trace;
  trace.height = 7;
  trace.columns = 11;
  trace.rows = 6;
  trace.contours = {{{1, 1}, {2, 1}, {1, 2}, {1, 1}}, {{8, 0}, {8, 5}}};
  trace.hulls = {{{1, 1}, {2, 1}, {1, 2}}, {{8, 2}}};
  trace.bitangents = {{{PlanPoint{1, 1}, PlanPoint{8, 2}}, true},
                      {{PlanPoint{2, 1}, PlanPoint{8, 2}}, true},
                      {{PlanPoint{1, 2}, PlanPoint{8, 2}}, false}};
  trace.candidates = {{PlanPoint{1, 0}, PlanPoint{1, 1}}};
  trace.horizon_points = {{1, 1}, {8, 2}};
  return trace;
}

// The content of the first group of a class.
std::string GroupOf(const std::string& svg, const std::string& name) {
  const std::size_t at = svg.find("<g class=\"" + name + "\">");
  EXPECT_NE(at, std::string::npos) << name;
  return svg.substr(at, svg.find("</g>", at) - at);
}

std::size_t CountOf(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST(DrawSweep, HasAGroupForEachKindWithAShapeForEachMember) {
  const std::string svg = DrawSweep(SomeTrace(), "a sweep");
  EXPECT_EQ(CountOf(GroupOf(svg, "contours"), "<path"), 2U);
  EXPECT_EQ(CountOf(GroupOf(svg, "hulls"), "Z\"/>"), 2U);
  EXPECT_EQ(CountOf(GroupOf(svg, "active"), "M"), 2U);
  EXPECT_EQ(CountOf(GroupOf(svg, "inactive"), "M"), 1U);
  EXPECT_EQ(CountOf(GroupOf(svg, "candidates"), "M"), 1U);
  EXPECT_EQ(CountOf(GroupOf(svg, "seen"), "<circle"), 2U);
}

TEST(DrawSweep, HasALegendWithTheCounts) {
  const std::string svg = DrawSweep(SomeTrace(), "a sweep");
  for (const char* line : {"a sweep", "contours: 2", "merged hulls: 2", "active bitangents: 2",
                           "inactive bitangents: 1", "candidate edges at this level: 1",
                           "seen on the horizon so far: 2"}) {
    EXPECT_THAT(svg, HasSubstr(std::string(">") + line + "</text>"));
  }
}

TEST(DrawSweep, IsAThousandPixelsWideWhateverTheTerrain) {
  for (const std::int32_t columns : {2, 11, 5000}) {
    SweepTrace trace = SomeTrace();
    trace.columns = columns;
    trace.rows = columns / 2 + 1;
    EXPECT_THAT(DrawSweep(trace, ""), HasSubstr("width=\"1000\""));
  }
  SweepTrace tall = SomeTrace();
  tall.rows = 101;
  EXPECT_THAT(DrawSweep(tall, ""), HasSubstr("height=\"1000\""));
}

TEST(DrawSweep, PutsThePlanWhereItIsRowsDownwards) {
  EXPECT_THAT(GroupOf(DrawSweep(SomeTrace(), ""), "candidates"), HasSubstr("M112,12L112,112"));
}

TEST(DrawSweep, EscapesTheTitleAndLeavesEveryTagClosed) {
  const std::string svg = DrawSweep(SomeTrace(), "<a & b>");
  EXPECT_THAT(svg, HasSubstr("<title>&lt;a &amp; b></title>"));
  EXPECT_EQ(CountOf(svg, "<g "), CountOf(svg, "</g>"));
  EXPECT_EQ(CountOf(svg, "<text"), CountOf(svg, "</text>"));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
}

TEST(DrawSweep, DrawsATraceOfNothing) {
  SweepTrace trace;
  trace.columns = 2;
  trace.rows = 2;
  EXPECT_THAT(DrawSweep(trace, ""), HasSubstr("merged hulls: 0"));
}

}  // namespace
}  // namespace farhorizon
