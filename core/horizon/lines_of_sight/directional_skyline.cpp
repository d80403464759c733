// Which edges can be on the skyline along u: those that have u in the closed set of their
// directions of sight (core/horizon/README.md, theorem 11). An edge too many does no harm, because
// the upper envelope leaves it out; so directions are angles in doubles, as intervals rounded
// outwards.
#include "core/horizon/lines_of_sight/directional_skyline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/geometry/interval_set.h"

namespace farhorizon {

namespace {

// The directions of a cell as angles from `along`, 0 to pi, rounded outwards. Its curves turn one
// way, so that they have their least and greatest angles at the cell's ends.
Interval AnglesOf(const LineOfSightCell& cell, const std::array<double, 2>& along) {
  // A direction is off by 2^-36 (lines_of_sight.h). Products, quotient and arcus tangent are off by
  // a few units in the last place of an angle below 2 pi, and so are the sums that turn it into an
  // azimuth of the half turn: by less than 1e-14 together.
  constexpr double kSlack = 0x1p-35;
  const auto angle = [&along](const PlanVector& direction) {
    const double cross = along[0] * direction.y - along[1] * direction.x;
    const double dot = along[0] * direction.x + along[1] * direction.y;
    return HalfTurnAngle(dot, cross);
  };
  const double from = std::min(angle(cell.first_ends[0]), angle(cell.first_ends[1]));
  const double to = std::max(angle(cell.last_ends[0]), angle(cell.last_ends[1]));
  return {from - kSlack, to + kSlack};
}

// Appends [from, to], angles of directions without a sense, as intervals of [0, pi].
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

// All directions of sight of an edge, as disjoint intervals of [0, pi].
std::vector<Interval> DirectionsOf(const LinesOfSight& lines, const Segment& edge) {
  const std::array<double, 2> along = {static_cast<double>(edge.b.x) - edge.a.x,
                                       static_cast<double>(edge.b.y) - edge.a.y};
  const double base = std::atan2(along[1], along[0]);
  std::vector<Interval> angles;
  for (const LineOfSightCell& cell : lines) {
    const Interval turned = AnglesOf(cell, along);
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

IntervalTree TreeOf(const std::vector<Segment>& edges, const std::vector<LinesOfSight>& lines) {
  std::vector<IntervalTree::Entry> all;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    if (lines[i].empty()) {  // undecided, or its lines of sight were not afforded
      all.push_back({0, std::numbers::pi, id});
      continue;
    }
    for (const Interval& angles : DirectionsOf(lines[i], edges[i])) {
      all.push_back({angles[0], angles[1], id});
    }
  }
  return IntervalTree(std::move(all));
}

// The t, from a to b, at which the edge has the offset.
double ShareAt(const Segment& edge, const ViewDirection& view, const Fraction& offset) {
  const std::int64_t a = Offset(edge.a, view);
  const std::int64_t run = Offset(edge.b, view) - a;
  const Int128 numerator = offset.numerator - a * offset.denominator;
  // + 0.0: never -0.
  return static_cast<double>(numerator) / static_cast<double>(run * offset.denominator) + 0.0;
}

}  // namespace

DirectionalSkylines::DirectionalSkylines(const Terrain& terrain, const Horizon& horizon,
                                         const std::vector<LinesOfSight>& lines)
    : edges_(SegmentsOf(terrain, horizon)), directions_(TreeOf(edges_, lines)) {}

std::vector<SkylinePiece> DirectionalSkylines::Along(const ViewDirection& view) const {
  std::vector<std::int32_t> visible = directions_.Holding(AngleOf(view));
  std::sort(visible.begin(), visible.end());
  std::vector<Segment> segments;
  segments.reserve(visible.size());
  for (const std::int32_t i : visible) segments.push_back(edges_[static_cast<std::size_t>(i)]);
  std::vector<SkylinePiece> skyline;
  for (const EnvelopePiece& piece : UpperEnvelope(segments, view)) {
    const Segment& edge = segments[piece.segment];
    skyline.push_back({static_cast<std::size_t>(visible[piece.segment]),
                       ShareAt(edge, view, piece.from), ShareAt(edge, view, piece.to)});
  }
  return skyline;
}

}  // namespace farhorizon
