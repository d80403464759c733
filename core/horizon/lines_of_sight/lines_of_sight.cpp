// The lines of sight of each edge are cells of (place on the edge, direction), found exactly
// (visible_region.h) over the other horizon edges, and converted to doubles at the end: places are
// counted from the edge's first end there, from its lower end here.
#include "core/horizon/lines_of_sight/lines_of_sight.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "core/horizon/budgeted_work.h"
#include "core/horizon/lines_of_sight/visible_region.h"
#include "core/horizon/visibility/segment_index.h"

namespace farhorizon {

namespace {

MovingVector VectorOf(const BoundaryCurve& curve, const TargetSegment& edge) {
  if (curve.kind == BoundaryCurve::Kind::kMoving) return curve.v;
  const std::int64_t dx = std::int64_t{edge.high.x} - edge.low.x;
  const std::int64_t dy = std::int64_t{edge.high.y} - edge.low.y;
  if (curve.kind == BoundaryCurve::Kind::kAlong) return {dx, dy, 0, 0};
  return {-dx, -dy, 0, 0};
}

PlanMotion MotionOf(MovingVector v, bool from_high) {
  // From the other end: 1 - t for t, and a half turn that begins at the opposite direction.
  if (from_high) v = {-v.ax - v.bx, -v.ay - v.by, v.bx, v.by};
  return {static_cast<double>(v.ax), static_cast<double>(v.ay), static_cast<double>(v.bx),
          static_cast<double>(v.by)};
}

LineOfSightCell::Ends EndsOf(const MovingVector& v, const StripCell& cell, bool from_high) {
  const PlanVector from = DirectionAt(v, cell.from);
  const PlanVector to = DirectionAt(v, cell.to);
  if (from_high) return {-to, -from};
  return {from, to};
}

// The cells of a region in doubles. from_high: t is to run from the edge's higher end.
LinesOfSight InDoubles(const VisibleRegion& region, const TargetSegment& edge, bool from_high) {
  LinesOfSight lines;
  for (const StripCell& exact : region.cells()) {
    LineOfSightCell cell;
    cell.from = exact.from.ToDouble();
    cell.to = exact.to.ToDouble();
    if (from_high) {
      cell.from = 1 - cell.from;
      cell.to = 1 - cell.to;
      std::swap(cell.from, cell.to);
    }
    const MovingVector first = VectorOf(exact.first, edge);
    const MovingVector last = VectorOf(exact.last, edge);
    cell.first = MotionOf(first, from_high);
    cell.last = MotionOf(last, from_high);
    cell.first_ends = EndsOf(first, exact, from_high);
    cell.last_ends = EndsOf(last, exact, from_high);
    lines.push_back(cell);
  }
  return lines;
}

}  // namespace

Result<std::vector<LinesOfSight>> FindLinesOfSight(const Terrain& terrain, const Horizon& horizon,
                                                   int threads, const RunControl& control) {
  WorkBudget any(WorkBudget::kMost);
  return FindLinesOfSight(terrain, horizon, threads, any, control);
}

Result<std::vector<LinesOfSight>> FindLinesOfSight(const Terrain& terrain, const Horizon& horizon,
                                                   int threads, WorkBudget& budget,
                                                   const RunControl& control) {
  control.Report(Stage::kLinesOfSight, 0);
  SegmentIndex index(terrain.dem().columns, terrain.dem().rows);
  for (const HorizonEdge& e : horizon.edges) {
    index.Insert({terrain.Point(e.edge.a), terrain.Point(e.edge.b)});
  }
  std::vector<LinesOfSight> lines(horizon.edges.size());
  // Returns the decisions that it takes: `limit` or more where it gives up.
  const auto find = [&](std::size_t i, std::int64_t limit) -> std::int64_t {
    if (horizon.edges[i].undecided) return 0;
    const SegmentIndex::Item& item = index.item(static_cast<std::int32_t>(i));
    const TargetSegment edge{item.low, item.high, Ties::kPass};
    VisibleRegion region(edge, WedgeOf(terrain, horizon.edges[i].edge));
    region.LimitWork(limit);
    for (const Segment& segment : horizon.virtual_occluders.Of(i)) {
      region.AddOccluder({segment.a, segment.b});
    }
    region.AddOccluders(index, static_cast<std::int32_t>(i));
    if (region.work() >= limit) return region.work();
    Check(!region.cells().empty(), "a horizon edge has lines of sight");
    lines[i] = InDoubles(region, edge, !(item.low == terrain.Point(horizon.edges[i].edge.a)));
    return region.work();
  };
  const auto find_some = [&](std::span<const std::size_t> edges, std::int64_t limit) {
    BudgetedWork::Done done;
    for (const std::size_t i : edges) {
      const std::int64_t spent = find(i, limit);
      done.spent += spent;
      if (spent >= limit) done.open.push_back(i);
    }
    return done;
  };
  const BudgetedWork work{
      .count = lines.size(),
      .attempt = find_some,
      .stage = Stage::kLinesOfSight,
      .what = "finding lines of sight of " + std::to_string(lines.size()) + " edges",
      .share = 0.5,
      .restart = [&lines] { std::fill(lines.begin(), lines.end(), LinesOfSight()); }};
  Result<std::vector<std::size_t>> open = WorkThrough(work, threads, budget, control);
  if (!open) return std::move(open.error());
  return lines;
}

}  // namespace farhorizon
