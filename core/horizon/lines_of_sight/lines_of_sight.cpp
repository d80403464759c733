#include "core/horizon/lines_of_sight/lines_of_sight.h"

#include <algorithm>
#include <utility>

#include "core/base/parallel_for.h"
#include "core/horizon/lines_of_sight/visible_region.h"
#include "core/horizon/visibility/segment_index.h"

namespace farhorizon {
namespace {

PlanMotion MotionOf(const BoundaryCurve& curve, const TargetSegment& edge, bool from_high) {
  const std::int64_t dx = std::int64_t{edge.high.x} - edge.low.x;
  const std::int64_t dy = std::int64_t{edge.high.y} - edge.low.y;
  MovingVector v = curve.v;
  if (curve.kind == BoundaryCurve::Kind::kAlong) v = {dx, dy, 0, 0};
  if (curve.kind == BoundaryCurve::Kind::kAgainst) v = {-dx, -dy, 0, 0};
  // The other way round: t runs down, and the half turn begins at the opposite direction.
  if (from_high) v = {-v.ax - v.bx, -v.ay - v.by, v.bx, v.by};
  return {static_cast<double>(v.ax), static_cast<double>(v.ay), static_cast<double>(v.bx),
          static_cast<double>(v.by)};
}

LinesOfSight SightsOf(const VisibleRegion& region, const TargetSegment& edge, bool from_high) {
  LinesOfSight sights;
  for (const StripCell& cell : region.cells()) {
    LineOfSightCell patch;
    patch.from = cell.from.ToDouble();
    patch.to = cell.to.ToDouble();
    if (from_high) {
      patch.from = 1 - patch.from;
      patch.to = 1 - patch.to;
      std::swap(patch.from, patch.to);
    }
    patch.first = MotionOf(cell.first, edge, from_high);
    patch.last = MotionOf(cell.last, edge, from_high);
    sights.push_back(patch);
  }
  return sights;
}

}  // namespace

Result<std::vector<LinesOfSight>> FindLinesOfSight(const Terrain& terrain, const Horizon& horizon,
                                                   int threads, const Watch& watch) {
  SegmentIndex index(terrain.dem().columns, terrain.dem().rows);
  for (const HorizonEdge& e : horizon.edges) {
    index.Insert({terrain.Point(e.edge.a), terrain.Point(e.edge.b)});
  }
  std::vector<LinesOfSight> sights(horizon.edges.size());
  const auto look = [&](std::size_t i) {
    if (horizon.edges[i].undecided) return;
    const SegmentIndex::Item& item = index.item(static_cast<std::int32_t>(i));
    const TargetSegment edge{item.low, item.high, Ties::kPass};
    VisibleRegion region(edge, WedgeOf(terrain, horizon.edges[i].edge));
    for (const Segment& segment : horizon.virtual_occluders.Of(i)) {
      region.Subtract({segment.a, segment.b});
    }
    region.Subtract(index, static_cast<std::int32_t>(i));
    Check(!region.cells().empty(), "an edge on the horizon has lines of sight");
    sights[i] = SightsOf(region, edge, !(item.low == terrain.Point(horizon.edges[i].edge.a)));
  };
  const auto look_at_all = [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
    for (std::size_t i = begin; i < end; ++i) look(i);
  };
  if (!ParallelForBatches(sights.size(), kBatch, threads, "sights", watch, look_at_all)) {
    return Error{ErrorCode::kCancelled, "stopped while finding lines of sight"};
  }
  return sights;
}

}  // namespace farhorizon
