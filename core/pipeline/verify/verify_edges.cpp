// The measures are found again by the code that found them first, and then checked without it:
// loops over the published edges say which is the skyline of random lines, and whether an edge is
// visible in a direction. Random lines are the same each time.
#include "core/pipeline/verify/verify_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "core/horizon/lines/grid_line_query.h"
#include "core/pipeline/verify/claims.h"
#include "core/pipeline/verify/published_set.h"
#include "core/pipeline/verify/random_line.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMostEdgesTried = 500;

using Interval = std::array<double, 2>;

bool Close(double a, double b, double margin) { return std::abs(a - b) <= margin; }

bool Close(const std::vector<Interval>& a, const std::vector<Interval>& b, double margin) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [margin](const Interval& p, const Interval& q) {
                      return Close(p[0], q[0], margin) && Close(p[1], q[1], margin);
                    });
}

// By how much a skyline drop may be too small, metres.
double SkylineDropMargin(double drop_m) {
  return std::max(kSkylineDropStep, kSkylineDropShare * drop_m);
}

// Measures of another build may round to the next step; half a step more is for the text.
bool Same(const EdgeMeasures& claimed, const EdgeMeasures& found) {
  constexpr double kRelative = 1e-6;
  return claimed.sights == found.sights && claimed.drop == found.drop &&
         Close(claimed.azimuths, found.azimuths, 1.5 * kAzimuthStep) &&
         Close(claimed.spans, found.spans, 1.5 * kSpanStep) &&
         Close(claimed.angular_share, found.angular_share, kRelative) &&
         Close(claimed.line_measure_m, found.line_measure_m,
               kRelative * (1 + found.line_measure_m)) &&
         Close(claimed.skyline_drop_m, found.skyline_drop_m,
               1.5 * SkylineDropMargin(found.skyline_drop_m));
}

bool IsIn(const std::vector<Interval>& intervals, double value, double margin) {
  return std::any_of(intervals.begin(), intervals.end(), [&](const Interval& i) {
    return value >= i[0] - margin && value <= i[1] + margin;
  });
}

// Of random lines, the number of those whose skyline is on an edge outside its azimuths or its
// spans, and of those whose skyline would be lower without the edge by more than its skyline drop.
struct LineCounts {
  int outside = 0;
  int beyond_skyline_drop = 0;
};

LineCounts CountLines(const Terrain& terrain, const Horizon& horizon, const PublishedSet& set,
                      const std::vector<HorizonFeature>& features,
                      const std::vector<GroundStep>& steps) {
  // Far above what rounding does to azimuths and spans, which are both for north at the edge's
  // middle; far below what a wrong one would be off by.
  constexpr double kAzimuthMargin = 1e-4;
  constexpr double kSpanMargin = 1e-6;
  const GridLineQuery ground(terrain);
  std::mt19937_64 random(1841);
  LineCounts counts;
  for (int i = 0; i < kRandomLines; ++i) {
    const PlanLine line = RandomLine(terrain.dem(), random);
    const std::optional<PublishedSet::EdgePoint> highest = set.HighestOver(line);
    if (!highest) continue;
    const EdgeMeasures& claimed = features[highest->edge].measures;
    double azimuth = steps[highest->edge].ToAzimuth(line.dc, line.dr);
    if (azimuth < 0) azimuth += 180;
    const bool inside = (IsIn(claimed.azimuths, azimuth, kAzimuthMargin) ||
                         IsIn(claimed.azimuths, azimuth + 180, kAzimuthMargin)) &&
                        IsIn(claimed.spans, highest->t, kSpanMargin);
    counts.outside += inside || claimed.sights != Known::kYes ? 0 : 1;
    if (claimed.drop != Known::kYes) continue;
    const Edge edge = horizon.edges[highest->edge].edge;
    const std::optional<HighestEdge> other =
        ground.HighestEdgeOver(edge, {line.x / 2.0, line.y / 2.0, 1.0 * line.dc, 1.0 * line.dr});
    const double low = terrain.Point(edge.a).z;
    const double own = low + highest->t * (terrain.Point(edge.b).z - low);
    const double lower_m = other ? (own - other->height) * terrain.dem().quantum_m : 0;
    // The search stops short of the truth, and the text is rounded to no more than as much again.
    const double margin_m = 2 * SkylineDropMargin(lower_m) + 1e-6;
    counts.beyond_skyline_drop += lower_m > claimed.skyline_drop_m + margin_m ? 1 : 0;
  }
  return counts;
}

// The widest of an edge's azimuths, and the widest gap between two of them. Requires: not empty.
std::array<Interval, 2> WidestOf(const std::vector<Interval>& azimuths) {
  std::array<Interval, 2> widest = {};
  for (std::size_t i = 0; i < azimuths.size(); ++i) {
    const Interval& here = azimuths[i];
    const double next = i + 1 < azimuths.size() ? azimuths[i + 1][0] : azimuths[0][0] + 180;
    if (here[1] - here[0] > widest[0][1] - widest[0][0]) widest[0] = here;
    if (next - here[1] > widest[1][1] - widest[1][0]) widest[1] = {here[1], next};
  }
  return widest;
}

// Of edges spread over the features, the number of those that are not visible along a direction
// within their widest azimuth, and of those that are visible along one within the widest gap
// between two.
struct VisibilityCounts {
  std::int64_t occluded_within = 0;
  std::int64_t visible_between = 0;
};

VisibilityCounts CountVisibility(const PublishedSet& set,
                                 const std::vector<HorizonFeature>& features,
                                 const std::vector<GroundStep>& steps) {
  // Not the middle, which is often the edge's own direction; any other value serves.
  constexpr double kWithin = 0.381966;
  // Narrower azimuths and gaps, degrees, are too near to their ends for what rounding does.
  constexpr double kNarrow = 1e-4;
  // A share that is zero comes out as some 1e-12.
  constexpr double kNothing = 1e-9;
  VisibilityCounts counts;
  const std::size_t stride = std::max<std::size_t>(features.size() / kMostEdgesTried, 1);
  for (std::size_t i = 0; i < features.size(); i += stride) {
    const std::vector<Interval>& azimuths = features[i].measures.azimuths;
    if (azimuths.empty()) continue;  // not afforded, or counted as different
    const auto share = [&](const Interval& interval) {
      return set.VisibleShare(i,
                              steps[i].ToGrid(interval[0] + kWithin * (interval[1] - interval[0])));
    };
    const auto [azimuth, gap] = WidestOf(azimuths);
    if (azimuth[1] - azimuth[0] > kNarrow && share(azimuth) <= 0) ++counts.occluded_within;
    if (gap[1] - gap[0] > kNarrow && share(gap) > kNothing) ++counts.visible_between;
  }
  return counts;
}

}  // namespace

Result<std::vector<ClaimCheck>> VerifyEdges(const TerrainInput& input, const Horizon& horizon,
                                            const std::vector<HorizonFeature>& features,
                                            const std::vector<HorizonFeature>& found,
                                            const std::string& source) {
  Claims claims;
  const Terrain& terrain = input.terrain();
  const Dem& dem = terrain.dem();
  const bool in_order =
      std::equal(features.begin(), features.end(), horizon.edges.begin(), horizon.edges.end(),
                 [&dem](const HorizonFeature& f, const HorizonEdge& e) {
                   return f.a == std::array{dem.Column(e.edge.a), dem.Row(e.edge.a)} &&
                          f.b == std::array{dem.Column(e.edge.b), dem.Row(e.edge.b)};
                 });
  claims.Add(in_order, source + " has the horizon edges by rising posts, each once");
  if (!in_order) return std::move(claims).Take();
  std::vector<std::array<double, 2>> middles;
  middles.reserve(features.size());
  for (const HorizonFeature& f : features) {
    middles.push_back({(f.a[0] + f.b[0]) / 2.0, (f.a[1] + f.b[1]) / 2.0});
  }
  Result<std::vector<GroundStep>> steps = input.georeference().StepsAt(middles);
  if (!steps) return std::move(steps.error());

  std::int64_t different = 0;
  std::int64_t other_context = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    different += Same(features[i].measures, found[i].measures) ? 0 : 1;
    other_context += features[i].in_context == found[i].in_context ? 0 : 1;
  }
  claims.Same(source + " edges with other azimuths, spans or weights", std::int64_t{0}, different);
  claims.Same(source + " edges with another context", std::int64_t{0}, other_context);
  const PublishedSet set(terrain, horizon);
  const LineCounts lines = CountLines(terrain, horizon, set, features, *steps);
  claims.Same(std::to_string(kRandomLines) +
                  " random lines with their skyline outside an edge's azimuths or spans",
              0, lines.outside);
  claims.Same(std::to_string(kRandomLines) +
                  " random lines whose edge rises above all others by more than its skyline drop",
              0, lines.beyond_skyline_drop);
  const VisibilityCounts directions = CountVisibility(set, features, *steps);
  claims.Same("edges that are not seen from within an azimuth", std::int64_t{0},
              directions.occluded_within);
  claims.Same("edges that are seen from between their azimuths", std::int64_t{0},
              directions.visible_between);
  return std::move(claims).Take();
}

}  // namespace farhorizon
