// Why the edges seen in the closed set of directions are enough. At each place across the view, H is the
// limit of H along lines beside it that have a horizon edge at their greatest height by D2 (horizon.md,
// theorem 2); of finitely many edges one is it on lines as close by as one likes, and so in the limit.
// A tie on a whole stretch is between edges in one plane with the direction. Turned a little to the side on
// which the nearest of them rises, it alone is at H: it is a horizon edge, with the direction in the closed
// set of its own. So the nearest of the terrain's edges is among those found, too.
#include "core/horizon/lines_of_sight/directional_skyline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/geometry/interval_set.h"

namespace farhorizon {
namespace {

// What doubles may be wrong by in an angle made of few steps.
constexpr double kAngleSlack = 1e-12;
// Ends of a patch are known to this share of it (lines_of_sight.h), with two bits to spare.
constexpr double kEndSlack = 0x1p-45;

// The angle of a moving vector at t from `along`, 0 to pi, and how much it may be wrong.
struct Angle {
  double value = 0;
  double slack = 0;
};

Angle AngleAt(const PlanMotion& motion, double t, const std::array<double, 2>& along) {
  const auto [x, y] = motion.At(t);
  const double cross = along[0] * y - along[1] * x;
  const double dot = along[0] * x + along[1] * y;
  const double size = std::hypot(motion.ax, motion.ay) + std::hypot(motion.bx, motion.by);
  return {HalfTurnAngle(dot, cross), kEndSlack * size / std::hypot(x, y) + kAngleSlack};
}

// The directions of a patch as angles from `along`, rounded outwards.
Interval AnglesOf(const LineOfSightCell& patch, const std::array<double, 2>& along) {
  constexpr double kUseless = 0.1;
  double from = std::numbers::pi;
  double to = 0;
  double slack = 0;
  for (const double t : {patch.from, patch.to}) {
    const Angle first = AngleAt(patch.first, t, along);
    const Angle last = AngleAt(patch.last, t, along);
    from = std::min(from, first.value);
    to = std::max(to, last.value);
    slack = std::max({slack, first.slack, last.slack});
  }
  if (!(slack < kUseless)) return {0, std::numbers::pi};
  return {from - slack, to + slack};
}

// Adds [from, to], angles of directions that have no sense, as parts of [0, pi].
void AppendHalfTurn(double from, double to, std::vector<Interval>& angles) {
  constexpr double kHalf = std::numbers::pi;
  if (to - from >= kHalf) {
    angles.push_back({0, kHalf});
    return;
  }
  const double shift = std::floor(from / kHalf) * kHalf;
  from -= shift;
  to -= shift;
  angles.push_back({from, std::min(to, kHalf)});
  if (to >= kHalf) angles.push_back({0, to - kHalf});
}

// All directions in which an edge is seen, as disjoint intervals of [0, pi].
std::vector<Interval> DirectionsOf(const LinesOfSight& sights, const Segment& edge) {
  const std::array<double, 2> along = {static_cast<double>(edge.b.x) - edge.a.x,
                                       static_cast<double>(edge.b.y) - edge.a.y};
  const double base = std::atan2(along[1], along[0]);
  std::vector<Interval> angles;
  for (const LineOfSightCell& patch : sights) {
    const Interval turned = AnglesOf(patch, along);
    AppendHalfTurn(base + turned[0], base + turned[1], angles);
  }
  return UnionOf(std::move(angles));
}

double AngleOf(const ViewDirection& view) {
  const double angle = std::atan2(view.dr, view.dc);
  return angle < 0 ? angle + std::numbers::pi : angle;
}

std::vector<Segment> SegmentsOf(const Terrain& terrain, const Horizon& horizon) {
  std::vector<Segment> segments;
  segments.reserve(horizon.edges.size());
  for (const HorizonEdge& e : horizon.edges) {
    segments.push_back({terrain.Point(e.edge.a), terrain.Point(e.edge.b)});
  }
  return segments;
}

IntervalTree TreeOf(const std::vector<Segment>& edges, const Horizon& horizon,
                    const std::vector<LinesOfSight>& sights) {
  std::vector<IntervalTree::Entry> all;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    if (horizon.edges[i].undecided) {
      all.push_back({0, std::numbers::pi, id});
      continue;
    }
    for (const Interval& angles : DirectionsOf(sights[i], edges[i])) {
      all.push_back({angles[0], angles[1], id});
    }
  }
  return IntervalTree(std::move(all));
}

// How far along the edge, from a to b, the place across the view is.
double ShareOf(const Segment& edge, const ViewDirection& view, const Fraction& place) {
  const std::int64_t a = Across(edge.a, view);
  const std::int64_t run = Across(edge.b, view) - a;
  const Int128 numerator = place.numerator - a * place.denominator;
  // + 0.0: never -0.
  return static_cast<double>(numerator) / static_cast<double>(run * place.denominator) + 0.0;
}

}  // namespace

DirectionalSkylines::DirectionalSkylines(const Terrain& terrain, const Horizon& horizon,
                                         const std::vector<LinesOfSight>& sights)
    : edges_(SegmentsOf(terrain, horizon)), directions_(TreeOf(edges_, horizon, sights)) {}

std::vector<SkylinePart> DirectionalSkylines::Along(const ViewDirection& view) const {
  std::vector<std::int32_t> seen = directions_.Holding(AngleOf(view));
  std::sort(seen.begin(), seen.end());
  std::vector<Segment> segments;
  segments.reserve(seen.size());
  for (const std::int32_t i : seen) segments.push_back(edges_[static_cast<std::size_t>(i)]);
  std::vector<SkylinePart> parts;
  for (const EnvelopePart& part : UpperEnvelope(segments, view)) {
    const Segment& edge = segments[part.segment];
    parts.push_back({static_cast<std::size_t>(seen[part.segment]), ShareOf(edge, view, part.from),
                     ShareOf(edge, view, part.to)});
  }
  return parts;
}

}  // namespace farhorizon
