#include "tests/support/matchers.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>

#include "tests/oracles/horizon_brute_force.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/line_equation.h"
#include "tests/support/shrink.h"
#include "tests/support/svg.h"

namespace farhorizon {
namespace {

using oracle::Wide;

std::vector<Edge> Minus(const std::vector<Edge>& a, const std::vector<Edge>& b) {
  std::vector<Edge> rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
  return rest;
}

std::string Names(const std::vector<Edge>& edges) {
  std::ostringstream out;
  for (const Edge e : edges) out << ' ' << e.a << '-' << e.b;
  return edges.empty() ? " none" : out.str();
}

std::string WriteSvg(const std::string& svg) {
  static int count = 0;
  const std::string path = testing::TempDir() + "horizon-" + std::to_string(++count) + ".svg";
  std::ofstream(path) << svg;
  return path;
}

using Int = __int128;
using Line = LineEquation<Int>;

std::int64_t Below(std::int64_t bound, std::mt19937& random) {
  return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(bound));
}

/// Through two random points of the plan, in halves of a cell.
Line AnyLine(const Dem& dem, std::mt19937& random) {
  for (;;) {
    const std::int64_t x0 = Below(2 * dem.columns, random);
    const std::int64_t y0 = Below(2 * dem.rows, random);
    const std::int64_t dx = Below(2 * dem.columns, random) - x0;
    const std::int64_t dy = Below(2 * dem.rows, random) - y0;
    // In halves: 2 x dy - 2 y dx = x0 dy - y0 dx.
    if (dx != 0 || dy != 0) return {2 * dy, -2 * dx, Int{x0} * dy - Int{y0} * dx};
  }
}

}  // namespace

testing::AssertionResult MatchesBruteForce(const Dem& dem, const HorizonFinder& find) {
  const auto fails = [&find](const Dem& d) {
    Result<Terrain> terrain = Terrain::Build(d);
    return terrain && find(*terrain) != HorizonByBruteForce(*terrain);
  };
  if (!fails(dem)) return testing::AssertionSuccess();
  const Dem small = Shrink(dem, fails);
  const Terrain terrain = *Terrain::Build(small);
  const std::vector<Edge> found = find(terrain);
  const std::vector<Edge> expected = HorizonByBruteForce(terrain);
  const std::vector<Edge> missing = Minus(expected, found);
  const std::vector<Edge> extra = Minus(found, expected);
  return testing::AssertionFailure()
         << "not the horizon of the definition, on this DEM, the smallest found:\n"
         << DrawAscii(small) << "missing:" << Names(missing) << "\nextra:" << Names(extra)
         << "\npicture: "
         << WriteSvg(DrawSvg(terrain,
                             {{"black", Minus(found, extra)}, {"red", missing}, {"blue", extra}}));
}

testing::AssertionResult MaximiserIsIn(const Terrain& terrain, const std::vector<Edge>& edges,
                                       int lines, std::uint32_t seed) {
  std::mt19937 random(seed);
  const std::vector<Segment> all = SegmentsOf(terrain, terrain.Edges());
  const std::vector<Segment> kept = SegmentsOf(terrain, edges);
  const auto greatest = [](const Line& line, const std::vector<Segment>& segments) {
    std::optional<Ratio<Int>> best;
    for (const Segment& s : segments) {
      const std::optional<Ratio<Int>> height = HeightOver<Int>(line, s);
      if (height && (!best || *best < *height)) best = height;
    }
    return best;
  };
  for (int i = 0; i < lines; ++i) {
    const Segment& through =
        all[static_cast<std::size_t>(Below(static_cast<std::int64_t>(all.size()), random))];
    const Line line = i % 2 == 0
                          ? AnyLine(terrain.dem(), random)
                          : LineThrough<Int>(through, 1 + Below(63, random), 64,
                                             Below(201, random) - 100, 1 + Below(99, random));
    const std::optional<Ratio<Int>> expected = greatest(line, all);
    const std::optional<Ratio<Int>> found = greatest(line, kept);
    if (expected.has_value() == found.has_value() && (!expected || *expected == *found)) continue;
    return testing::AssertionFailure()
           << "over the line " << static_cast<std::int64_t>(line.a) << " x + "
           << static_cast<std::int64_t>(line.b) << " y = " << static_cast<std::int64_t>(line.c)
           << " no edge of the set attains the greatest height";
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult LineOfSightIsClear(const Witness& witness, const Segment& segment,
                                            const std::vector<Segment>& obstacles, Ties ties) {
  const auto bad = [&witness] {
    return testing::AssertionFailure() << "witness t = " << witness.t << ", direction ("
                                       << witness.dc << ", " << witness.dr << "): ";
  };
  if (!(witness.t > 0 && witness.t < 1)) return bad() << "t is not inside the edge";
  const std::int64_t turn = (std::int64_t{segment.b.x} - segment.a.x) * witness.dr -
                            (std::int64_t{segment.b.y} - segment.a.y) * witness.dc;
  if (turn == 0) return bad() << "it runs along the edge";
  int exponent = 0;
  const double mantissa = std::frexp(witness.t, &exponent);  // in [0.5, 1): 53 bits
  const Wide numerator = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
  const Wide denominator = Wide(1) << static_cast<unsigned>(53 - exponent);
  const LineEquation<Wide> line =
      LineThrough<Wide>(segment, numerator, denominator, witness.dc, witness.dr);
  const Ratio<Wide> own{segment.a.z * denominator + (Wide(segment.b.z) - segment.a.z) * numerator,
                        denominator};
  for (const Segment& f : obstacles) {
    const std::optional<Ratio<Wide>> height = HeightOver<Wide>(line, f);
    if (!height || *height < own || (ties == Ties::kPass && *height == own)) continue;
    return bad() << "it is blocked by " << DrawSegments({f});
  }
  return testing::AssertionSuccess();
}

std::vector<Segment> SegmentsOf(const Terrain& terrain, const std::vector<Edge>& edges) {
  std::vector<Segment> segments;
  segments.reserve(edges.size());
  for (const Edge e : edges) segments.push_back({terrain.Point(e.a), terrain.Point(e.b)});
  return segments;
}

std::string DrawSegments(const std::vector<Segment>& segments) {
  std::ostringstream out;
  for (const Segment& s : segments) {
    out << "{{" << s.a.x << ", " << s.a.y << ", " << s.a.z << "}, {" << s.b.x << ", " << s.b.y
        << ", " << s.b.z << "}},\n";
  }
  return out.str();
}

}  // namespace farhorizon
