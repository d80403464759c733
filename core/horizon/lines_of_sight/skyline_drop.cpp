// An edge is lowered as long as it is visible over all others; the depth reached is its drop. How
// deep that is, is found in doubles: by climbing to a line of sight with the greatest clearance
// (clearance_climb.h). It is then proved once that the edge is occluded everywhere when it is
// lowered by the tolerance more. A point of the edge that is occluded is so with a whole range of t
// around it, and remains so however low the edge gets: so each range of t is settled once. Where
// the proof meets a point that is visible all the same, the climb goes on from there.
//
//      edge            o--------------o
//                      :  clearance   :          depth
//      lowered by it   o--------------o
//      another edge  -----x-----
//
// Occluders are at first the other horizon edges, the edges of the faces beside the edge, and its
// virtual occluders (Horizon::virtual_occluders), which stand for ground at the height of its upper
// end or above, so for ground that is not the edge's own. Other edges of the terrain may be higher
// than the lowered edge: those are found by the climb's line queries, and added.
//
// Heights of other edges and of the lowered one are in steps (core/geometry/finer_heights.h). They
// span up to 2^32 steps, twice what an occluder set admits, but plan coordinates are those of a
// DEM, half of what it admits: the vectors of a TargetSegment, sums of two products of the two, are
// below 2^(15 + 32 + 1), so within MovingVector's limit.
#include "core/horizon/lines_of_sight/skyline_drop.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "core/horizon/lines_of_sight/clearance_climb.h"
#include "core/horizon/visibility/point_query.h"
#include "core/horizon/work_budget.h"
#include "core/terrain/height_range.h"

namespace farhorizon {

class SkylineDrops::LoweredEdge {
 public:
  // limit: of decisions.
  LoweredEdge(const SkylineDrops& all, std::size_t i, std::int64_t limit)
      : all_(all),
        i_(static_cast<std::int32_t>(i)),
        edge_(all.horizon_.edges[i].edge),
        climb_(all.terrain_, all.lines_, edge_),
        limit_(limit) {
    for (const Segment& segment : all.horizon_.virtual_occluders.Of(i)) AddVirtualOccluder(segment);
    AddObstacles();
  }

  // Decisions, of the climbs' line queries too.
  [[nodiscard]] std::int64_t spent() const { return spent_ + climb_.work(); }

  // The greatest depth at which the edge is known to be visible, in quanta. Has no meaning where
  // the limit is spent.
  double FindDepth() {
    const Witness& witness = all_.horizon_.edges[static_cast<std::size_t>(i_)].witness;
    // A witness that is not exact is rounded: near a line of sight all the same.
    Climb(ClearanceClimb::LineThrough(witness.t, static_cast<double>(witness.dc),
                                      static_cast<double>(witness.dr)));
    std::deque<OccludedRange> open = {
        {QuadraticRoot::At(Dyadic{0, 0}), QuadraticRoot::At(Dyadic{1, 0})}};
    while (!open.empty() && spent() < limit_) {
      const OccludedRange range = open.front();
      open.pop_front();
      const std::optional<WideDyadic> t = Between(range.from, range.to);
      if (!t) continue;
      const OccludedRange occluded = LowerAt(*t);
      open.push_back({range.from, occluded.from});
      open.push_back({occluded.to, range.to});
    }
    return depth_;
  }

 private:
  void AddVirtualOccluder(const Segment& segment) {
    Segment scaled = all_.Scaled(segment);
    if (scaled.a.z > scaled.b.z) std::swap(scaled.a, scaled.b);
    virtual_occluders_.push_back(scaled);
  }

  // Makes the obstacles that the climb has met since the last call virtual occluders. False where
  // it has met none.
  bool AddObstacles() {
    const std::vector<Edge>& met = climb_.obstacles();
    if (obstacles_added_ == met.size()) return false;
    for (; obstacles_added_ < met.size(); ++obstacles_added_) {
      const Edge edge = met[obstacles_added_];
      AddVirtualOccluder({all_.terrain_.Point(edge.a), all_.terrain_.Point(edge.b)});
    }
    return true;
  }

  // Raises the depth to the greatest clearance near a line. False where it stays.
  bool Climb(const ClearanceClimb::Line& line) {
    const double clearance = climb_.ClimbFrom(line, all_.tolerance_, kRelativeTolerance);
    AddObstacles();
    if (clearance <= depth_) return false;
    depth_ = clearance;
    return true;
  }

  // How much more than the depth found the edge is lowered in the proof, quanta.
  [[nodiscard]] double Margin() const {
    return std::max(all_.tolerance_, kRelativeTolerance * depth_);
  }

  // The depth of the proof, in steps: above the depth found, by no more than the margin where that
  // holds a step.
  [[nodiscard]] std::int32_t StepsOfProof() const {
    const std::int32_t steps = all_.heights_.Steps(depth_ + Margin());
    return std::max(steps, all_.heights_.Steps(depth_) + 1);
  }

  // Lowers the edge until its point at t is occluded, and returns a range around t that is so then.
  OccludedRange LowerAt(const WideDyadic& t) {
    while (spent() < limit_) {
      const Segment own{all_.terrain_.Point(edge_.a), all_.terrain_.Point(edge_.b)};
      const std::int32_t steps = StepsOfProof();
      const VisibilityQuery query{
          .segment = Lowered(all_.Scaled(own), steps),
          .except = i_,
          .hints = {.virtual_occluders = virtual_occluders_, .likely = likely_},
          .decision_limit = limit_ - spent()};
      PointQuery points(all_.skyline_, query);
      const PointAnswer point = points.AnswerAt(t);
      spent_ += points.counts().Sum();
      if (point.gave_up) break;
      if (!point.witness) {
        // What occludes one point is likely to occlude the next.
        likely_ = points.occluders();
        return point.occluded;
      }
      const std::size_t known = climb_.obstacles().size();
      const bool deeper = Climb(ClearanceClimb::LineThrough(
          point.witness->t, point.free_direction[0], point.free_direction[1]));
      // Line queries are rounded. Where one tells nothing new, the exact answer counts: at the
      // depth of the proof the edge is visible.
      if (!deeper && climb_.obstacles().size() == known) depth_ = all_.heights_.Quanta(steps);
    }
    spent_ = std::max(spent_, limit_);
    return {};
  }

  const SkylineDrops& all_;
  std::int32_t i_;
  Edge edge_;
  ClearanceClimb climb_;
  std::size_t obstacles_added_ = 0;
  std::vector<Segment> virtual_occluders_;
  std::vector<std::int32_t> likely_;
  double depth_ = 0;    // at which the edge is visible, or occluded by ties only
  std::int64_t limit_;  // of decisions
  std::int64_t spent_ = 0;
};

SkylineDrops::SkylineDrops(const Terrain& terrain, const Horizon& horizon, double tolerance)
    : terrain_(terrain),
      horizon_(horizon),
      tolerance_(tolerance),
      lines_(terrain),
      heights_(FinerHeights::FromLeast(HeightRangeOf(terrain.dem()), tolerance)),
      skyline_(terrain.dem().columns, terrain.dem().rows) {
  for (const HorizonEdge& e : horizon.edges) {
    skyline_.Insert(Scaled({terrain.Point(e.edge.a), terrain.Point(e.edge.b)}));
  }
}

Segment SkylineDrops::Scaled(const Segment& segment) const {
  return {heights_.Scale(segment.a), heights_.Scale(segment.b)};
}

double SkylineDrops::Of(std::size_t i) const { return Find(i, WorkBudget::kMost).quanta.value(); }

SkylineDrops::Drop SkylineDrops::Find(std::size_t i, std::int64_t limit) const {
  if (horizon_.edges[i].undecided) return {.quanta = 0};
  LoweredEdge edge(*this, i, limit);
  const double depth = edge.FindDepth();
  if (edge.spent() >= limit) return {.quanta = std::nullopt, .spent = edge.spent()};
  return {.quanta = depth, .spent = edge.spent()};
}

}  // namespace farhorizon
