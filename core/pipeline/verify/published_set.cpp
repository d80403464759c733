// The definition, asked again of published edges: each question is a loop over all segments, with
// none of the indexes that the horizon was found with, so that verification shares no fault with
// them.
#include "core/pipeline/verify/published_set.h"

#include <algorithm>
#include <utility>

namespace farhorizon {

namespace {

// Where `line` crosses the segment, from 0 at its end a to 1 at b.
double CrossingOf(const Segment& segment, const PlanLine& line) {
  const auto side = [&line](const Point3i& p) {
    return (2.0 * p.x - line.x) * line.dr - (2.0 * p.y - line.y) * line.dc;
  };
  return side(segment.a) / (side(segment.a) - side(segment.b));
}

}  // namespace

PublishedSet::PublishedSet(const Terrain& terrain, const Horizon& horizon) {
  segments_.reserve(horizon.edges.size());
  for (const HorizonEdge& e : horizon.edges) {
    segments_.push_back({terrain.Point(e.edge.a), terrain.Point(e.edge.b)});
  }
}

std::optional<PublishedSet::EdgePoint> PublishedSet::HighestOver(const PlanLine& line) const {
  std::optional<ExactHeight> highest;
  std::size_t at = 0;
  bool shared = false;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const std::optional<ExactHeight> height = HeightOver(segments_[i], line);
    if (!height) continue;
    const int order = highest ? Compare(*height, *highest) : 1;
    if (order < 0) continue;
    shared = order == 0;
    if (order == 0) continue;
    highest = height;
    at = i;
  }
  if (!highest || shared) return std::nullopt;
  return EdgePoint{at, CrossingOf(segments_[at], line)};
}

double PublishedSet::VisibleShare(std::size_t i, std::array<double, 2> direction) const {
  const auto offset = [&direction](const Point3i& p) {
    return direction[0] * p.y - direction[1] * p.x;
  };
  const Segment& e = segments_[i];
  const double start = offset(e.a);
  const double run = offset(e.b) - start;
  std::vector<std::array<double, 2>> occluded;
  for (std::size_t j = 0; j < segments_.size(); ++j) {
    const Segment& f = segments_[j];
    if (j == i || std::max(f.a.z, f.b.z) <= std::min(e.a.z, e.b.z)) continue;
    // The positions on e of the lines of sight through f's ends, and f's height over e there.
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
    const double crossing = from + (to - from) * over_from / (over_from - over_to);
    if (over_from <= 0) from = crossing;
    if (over_to <= 0) to = crossing;
    if (to > 0 && from < 1) occluded.push_back({std::max(from, 0.0), std::min(to, 1.0)});
  }
  std::sort(occluded.begin(), occluded.end());
  double visible = 0;
  double reached = 0;
  for (const std::array<double, 2>& interval : occluded) {
    visible += std::max(interval[0] - reached, 0.0);
    reached = std::max(reached, interval[1]);
  }
  return visible + std::max(1 - reached, 0.0);
}

}  // namespace farhorizon
