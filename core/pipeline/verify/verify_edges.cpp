#include "core/pipeline/verify/verify_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "core/horizon/lines/grid_line_query.h"
#include "core/horizon/lines/highest_over_line.h"
#include "core/pipeline/edge_measures.h"

namespace farhorizon {
namespace {

constexpr int kRandomLines = 1000;
constexpr std::size_t kMostShots = 500;
constexpr double kDegrees = 180 / std::numbers::pi;

using Interval = std::array<double, 2>;

bool Close(double a, double b, double margin) { return std::abs(a - b) <= margin; }

bool Close(const std::vector<Interval>& a, const std::vector<Interval>& b, double margin) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [margin](const Interval& p, const Interval& q) {
                      return Close(p[0], q[0], margin) && Close(p[1], q[1], margin);
                    });
}

bool Same(const HorizonFeature& f, const EdgeMeasures& view) {
  constexpr double kRelative = 1e-6;
  return Close(f.azimuths, view.azimuths, 1.5 * kAzimuthStep) &&
         Close(f.spans, view.spans, 1.5 * kSpanStep) &&
         Close(f.angular_share, view.angular_share, kRelative) &&
         Close(f.line_measure_m, view.line_measure_m, kRelative * (1 + view.line_measure_m)) &&
         Close(f.skyline_drop_m, view.skyline_drop_m, 1.5 * kSkylineDropStep);
}

bool Within(const std::vector<Interval>& intervals, double value, double margin) {
  return std::any_of(intervals.begin(), intervals.end(), [&](const Interval& i) {
    return value >= i[0] - margin && value <= i[1] + margin;
  });
}

struct Direction {
  double columns;
  double rows;
};

double AzimuthOf(const Direction& d, const GroundStep& step) {
  const double east = step.column_east_m * d.columns + step.row_east_m * d.rows;
  const double north = step.column_north_m * d.columns + step.row_north_m * d.rows;
  const double azimuth = std::atan2(east, north) * kDegrees;
  return azimuth < 0 ? azimuth + 180 : azimuth;
}

Direction DirectionOf(double azimuth, const GroundStep& step) {
  const double east = std::sin(azimuth / kDegrees);
  const double north = std::cos(azimuth / kDegrees);
  const double det = step.column_east_m * step.row_north_m - step.row_east_m * step.column_north_m;
  return {(east * step.row_north_m - north * step.row_east_m) / det,
          (north * step.column_east_m - east * step.column_north_m) / det};
}

// The published set, asked along lines.
class Shooter {
 public:
  Shooter(const Terrain& terrain, const Horizon& horizon) {
    for (const HorizonEdge& e : horizon.edges) {
      set_.push_back({terrain.Point(e.edge.a), terrain.Point(e.edge.b)});
    }
  }

  // The one edge that is highest over the line, and where; nullopt where there are several or none.
  struct Hit {
    std::size_t edge;
    double t;
  };
  [[nodiscard]] std::optional<Hit> Highest(const PlanLine& line) const {
    std::optional<ExactHeight> highest;
    std::size_t at = 0;
    bool shared = false;
    for (std::size_t i = 0; i < set_.size(); ++i) {
      const std::optional<ExactHeight> height = HeightOver(set_[i], line);
      if (!height) continue;
      const int order = highest ? Compare(*height, *highest) : 1;
      if (order < 0) continue;
      shared = order == 0;
      if (order == 0) continue;
      highest = height;
      at = i;
    }
    if (!highest || shared) return std::nullopt;
    return Hit{at, Position(set_[at], line)};
  }

  // The share of the edge that shows in the direction: what no other edge of the set hides.
  [[nodiscard]] double ShareSeen(std::size_t i, const Direction& d) const {
    const auto offset = [&d](const Point3i& p) { return d.columns * p.y - d.rows * p.x; };
    const Segment& e = set_[i];
    const double start = offset(e.a);
    const double run = offset(e.b) - start;
    std::vector<Interval> hidden;
    for (std::size_t j = 0; j < set_.size(); ++j) {
      const Segment& f = set_[j];
      if (j == i || std::max(f.a.z, f.b.z) <= std::min(e.a.z, e.b.z)) continue;
      // Where f begins and ends, as positions on e, and its height over e there.
      double from = (offset(f.a) - start) / run;
      double to = (offset(f.b) - start) / run;
      const auto own = [&e](double t) { return e.a.z + t * (static_cast<double>(e.b.z) - e.a.z); };
      double over_from = f.a.z - own(from);
      double over_to = f.b.z - own(to);
      if (from > to) {
        std::swap(from, to);
        std::swap(over_from, over_to);
      }
      if (over_from <= 0 && over_to <= 0) continue;
      const double level = from + (to - from) * over_from / (over_from - over_to);
      if (over_from <= 0) from = level;
      if (over_to <= 0) to = level;
      if (to > 0 && from < 1) hidden.push_back({std::max(from, 0.0), std::min(to, 1.0)});
    }
    std::sort(hidden.begin(), hidden.end());
    double seen = 0;
    double reached = 0;
    for (const Interval& h : hidden) {
      seen += std::max(h[0] - reached, 0.0);
      reached = std::max(reached, h[1]);
    }
    return seen + std::max(1 - reached, 0.0);
  }

 private:
  static double Position(const Segment& s, const PlanLine& line) {
    const auto side = [&line](const Point3i& p) {
      return (2.0 * p.x - line.x) * line.dr - (2.0 * p.y - line.y) * line.dc;
    };
    return side(s.a) / (side(s.a) - side(s.b));
  }

  std::vector<Segment> set_;
};

PlanLine RandomLine(const Dem& dem, std::mt19937_64& random) {
  const auto draw = [&random](std::int32_t below) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(below));
  };
  PlanLine line{draw(2 * dem.columns), draw(2 * dem.rows), draw(2001) - 1000, draw(2001) - 1000};
  if (line.dc == 0 && line.dr == 0) line.dc = 1;
  return line;
}

// Of random lines, how many have their skyline on an edge outside its azimuths or its spans, and on how many
// it would be lower by more than the edge's skyline drop if that were not there.
struct LineCounts {
  int outside = 0;
  int beyond_skyline_drop = 0;
};

LineCounts CountLines(const Terrain& terrain, const Horizon& horizon, const Shooter& shooter,
                      const std::vector<HorizonFeature>& features,
                      const std::vector<GroundStep>& steps) {
  // Lines that cross an edge far from where its north was taken are a little off.
  constexpr double kAzimuthMargin = 1e-4;
  constexpr double kSpanMargin = 1e-6;
  // Found and then rounded to so much.
  constexpr double kSkylineDropMargin = 2 * kSkylineDropStep + 1e-6;
  const GridLineQuery walk(terrain);
  std::mt19937_64 random(1841);
  LineCounts counts;
  for (int i = 0; i < kRandomLines; ++i) {
    const PlanLine line = RandomLine(terrain.dem(), random);
    const std::optional<Shooter::Hit> hit = shooter.Highest(line);
    if (!hit) continue;
    const HorizonFeature& f = features[hit->edge];
    if (f.undecided) continue;
    const double azimuth =
        AzimuthOf({static_cast<double>(line.dc), static_cast<double>(line.dr)}, steps[hit->edge]);
    const bool inside = (Within(f.azimuths, azimuth, kAzimuthMargin) ||
                         Within(f.azimuths, azimuth + 180, kAzimuthMargin)) &&
                        Within(f.spans, hit->t, kSpanMargin);
    counts.outside += inside ? 0 : 1;
    const Edge edge = horizon.edges[hit->edge].edge;
    const std::optional<HighestEdge> other =
        walk.HighestEdgeOver(edge, line.x / 2.0, line.y / 2.0, line.dc, line.dr);
    const double low = terrain.Point(edge.a).z;
    const double own = low + hit->t * (terrain.Point(edge.b).z - low);
    const double lower_m = other ? (own - other->height) * terrain.dem().quantum_m : 0;
    counts.beyond_skyline_drop += lower_m > f.skyline_drop_m + kSkylineDropMargin ? 1 : 0;
  }
  return counts;
}

// The widest azimuth of an edge, and the widest gap between two. Requires: there are azimuths.
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

}  // namespace

Status VerifyEdges(const TerrainInput& source, const Horizon& horizon,
                   const std::vector<HorizonFeature>& features, int threads, const Watch& watch,
                   Claims& claims) {
  const Terrain& terrain = source.terrain();
  const Dem& dem = terrain.dem();
  const bool in_order =
      std::equal(features.begin(), features.end(), horizon.edges.begin(), horizon.edges.end(),
                 [&dem](const HorizonFeature& f, const HorizonEdge& e) {
                   return f.a == std::array{dem.Column(e.edge.a), dem.Row(e.edge.a)} &&
                          f.b == std::array{dem.Column(e.edge.b), dem.Row(e.edge.b)};
                 });
  claims.Add(in_order, "horizon.geojson has the horizon edges by rising posts, each once");
  if (!in_order) return Done{};
  Result<std::vector<EdgeMeasures>> views =
      MeasureEdges(terrain, horizon, source.georeference(), threads, watch);
  if (!views) return std::move(views.error());
  watch.Report(Stage::kVerify, kVerifiedBeforeSights);
  std::vector<Interval> middles;
  middles.reserve(features.size());
  for (const HorizonFeature& f : features) {
    middles.push_back({(f.a[0] + f.b[0]) / 2.0, (f.a[1] + f.b[1]) / 2.0});
  }
  Result<std::vector<GroundStep>> steps = source.georeference().StepsAt(middles);
  if (!steps) return std::move(steps.error());

  std::int64_t different = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    different += Same(features[i], (*views)[i]) ? 0 : 1;
  }
  claims.Same("horizon.geojson edges with other azimuths, spans or weights", std::int64_t{0},
              different);
  const Shooter shooter(terrain, horizon);
  const LineCounts lines = CountLines(terrain, horizon, shooter, features, *steps);
  claims.Same(std::to_string(kRandomLines) +
                  " random lines with their skyline outside an edge's azimuths or spans",
              0, lines.outside);
  claims.Same(std::to_string(kRandomLines) +
                  " random lines whose edge rises above all others by more than its skyline drop",
              0, lines.beyond_skyline_drop);
  // Not the middle, which is often the edge's own direction.
  constexpr double kWithin = 0.381966;
  // Narrower than this it is too near to the ends for what rounding does.
  constexpr double kNarrow = 1e-4;
  constexpr double kNothing = 1e-9;
  std::int64_t unseen = 0;
  std::int64_t seen = 0;
  const std::size_t stride = std::max<std::size_t>(features.size() / kMostShots, 1);
  for (std::size_t i = 0; i < features.size(); i += stride) {
    if (features[i].azimuths.empty()) continue;  // undecided, or told as different above
    const auto share = [&](const Interval& interval) {
      return shooter.ShareSeen(
          i, DirectionOf(interval[0] + kWithin * (interval[1] - interval[0]), (*steps)[i]));
    };
    const auto [azimuth, gap] = WidestOf(features[i].azimuths);
    if (azimuth[1] - azimuth[0] > kNarrow && share(azimuth) <= 0) ++unseen;
    if (gap[1] - gap[0] > kNarrow && share(gap) > kNothing) ++seen;
  }
  claims.Same("edges that are not seen from within an azimuth", std::int64_t{0}, unseen);
  claims.Same("edges that are seen from between their azimuths", std::int64_t{0}, seen);
  return Done{};
}

}  // namespace farhorizon
