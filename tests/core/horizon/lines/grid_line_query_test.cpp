#include "core/horizon/lines/grid_line_query.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/lines/highest_over_line.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

// A line through a post or half way between two, inside the grid; often along rows, columns or
// diagonals.
PlanLine AnyGridLine(const Dem& dem, std::mt19937& random) {
  const auto below = [&random](std::int32_t n) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(n));
  };
  const std::int32_t steepest = 1 + below(2) * 40;
  PlanLine line{below(2 * dem.columns - 1), below(2 * dem.rows - 1), 0, 0};
  while (line.dc == 0 && line.dr == 0) {
    line.dc = below(2 * steepest + 1) - steepest;
    line.dr = below(2 * steepest + 1) - steepest;
  }
  return line;
}

double ToDouble(const ExactHeight& height) {
  return static_cast<double>(height.numerator) / static_cast<double>(height.denominator);
}

// GridLineQuery agrees with the definition for all edges except one.
testing::AssertionResult AgreesWithTheDefinition(const Dem& dem, int lines, std::mt19937& random) {
  Result<Terrain> terrain = Terrain::Build(dem);
  if (!terrain) return testing::AssertionSuccess();
  const GridLineQuery query(*terrain);
  const std::vector<Edge> edges = terrain->Edges();
  for (int i = 0; i < lines; ++i) {
    const PlanLine line = AnyGridLine(dem, random);
    const Edge except = edges[random() % edges.size()];
    std::vector<Segment> others;
    for (const Edge e : edges) {
      if (e != except) others.push_back({terrain->Point(e.a), terrain->Point(e.b)});
    }
    const std::optional<ExactHeight> height = HighestOver(others, line);
    const std::optional<HighestEdge> found =
        query.HighestEdgeOver(except, {line.x / 2.0, line.y / 2.0, 1.0 * line.dc, 1.0 * line.dr});
    if (found.has_value() != height.has_value()) {
      return testing::AssertionFailure()
             << DrawAscii(dem) << "one of them finds no edge: line " << line.x << " " << line.y
             << " " << line.dc << " " << line.dr << " except " << except.a << "-" << except.b
             << " def " << height.has_value();
    }
    if (!found) continue;
    const GridLineQuery::Line same{line.x / 2.0, line.y / 2.0, 1.0 * line.dc, 1.0 * line.dr};
    if (query.HighestEdgeOver(except, same, found->height) ||
        !query.HighestEdgeOver(except, same, found->height - 1e-3)) {
      return testing::AssertionFailure() << DrawAscii(dem) << "a floor is not kept";
    }
    const Segment highest{terrain->Point(found->edge.a), terrain->Point(found->edge.b)};
    const std::optional<ExactHeight> of_edge = HeightOver(highest, line);
    if (std::abs(found->height - ToDouble(*height)) > 1e-6 || found->edge == except || !of_edge ||
        std::abs(ToDouble(*of_edge) - found->height) > 1e-6) {
      return testing::AssertionFailure()
             << DrawAscii(dem) << "line " << line.x << "/2 " << line.y << "/2 along " << line.dc
             << ' ' << line.dr << " without " << except.a << '-' << except.b << ": found "
             << found->height << ", is " << ToDouble(*height);
    }
  }
  return testing::AssertionSuccess();
}

TEST(GridLineQuery, FindsTheHighestOtherEdge) {
  std::mt19937 random(2);
  for (int i = 0; i < Rounds(2000); ++i) {
    ASSERT_TRUE(AgreesWithTheDefinition(AnyRandomDem(3, 8, random), 20, random));
  }
}

TEST(GridLineQuery, FindsItBeyondManyBlocks) {
  std::mt19937 random(3);
  for (int i = 0; i < Rounds(40); ++i) {
    ASSERT_TRUE(AgreesWithTheDefinition(AnyLandscape(40, 70, random), 20, random));
  }
}

}  // namespace
}  // namespace farhorizon
