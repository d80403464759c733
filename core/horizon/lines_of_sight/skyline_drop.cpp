// An edge is lowered step by step as long as it is visible over all others; the depth reached is
// its drop. A point of the edge that is visible allows a depth: the clearance along its line of
// sight. A point that is occluded is so with a whole range of t around it, and remains so however
// low the edge gets. So each range of t is settled once.
//
//      edge            o--------------o
//                      :  clearance   :          depth
//      lowered by it   o--------------o
//      another edge  -----x-----
//
// Occluders are at first the other horizon edges, the edges of the faces beside the edge, and its
// virtual occluders (Horizon::virtual_occluders), which stand for ground at the height of its upper
// end or above, so for ground that is not the edge's own. Other edges of the terrain may be higher
// than the lowered edge: those are found by walking along its lines of sight, and added.
#include "core/horizon/lines_of_sight/skyline_drop.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

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
        limit_(limit) {
    const Horizon& horizon = all.horizon_;
    for (const Segment& segment : horizon.virtual_occluders.Of(i)) AddVirtualOccluder(segment);
    const Terrain::Faces faces = all.terrain_.FacesOf(edge_);
    for (const std::optional<VertexId> third : {faces.left, faces.right}) {
      if (!third) continue;
      AddVirtualOccluder({all.terrain_.Point(edge_.a), all.terrain_.Point(*third)});
      AddVirtualOccluder({all.terrain_.Point(edge_.b), all.terrain_.Point(*third)});
    }
  }

  [[nodiscard]] std::int64_t spent() const { return spent_; }

  // The greatest depth at which the edge is visible, in steps. Has no meaning where the limit is
  // spent.
  std::int32_t FindDepth() {
    std::deque<OccludedRange> open = {
        {QuadraticRoot::At(Dyadic{0, 0}), QuadraticRoot::At(Dyadic{1, 0})}};
    while (!open.empty() && spent_ < limit_) {
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
  // False where the segment has been added before.
  bool AddVirtualOccluder(const Segment& segment) {
    Segment scaled = all_.Scaled(segment);
    if (scaled.a.z > scaled.b.z) std::swap(scaled.a, scaled.b);
    const auto same = [&scaled](const Segment& s) { return s.a == scaled.a && s.b == scaled.b; };
    if (std::any_of(virtual_occluders_.begin(), virtual_occluders_.end(), same)) return false;
    virtual_occluders_.push_back(scaled);
    return true;
  }

  // Lowers the edge until its point at t is occluded, and returns a range around t that is so then.
  OccludedRange LowerAt(const WideDyadic& t) {
    while (spent_ < limit_) {
      const Segment own{all_.terrain_.Point(edge_.a), all_.terrain_.Point(edge_.b)};
      const VisibilityQuery query{
          .segment = Lowered(all_.Scaled(own), depth_ + 1),
          .except = i_,
          .hints = {.virtual_occluders = virtual_occluders_, .likely = likely_},
          .decision_limit = limit_ - spent_};
      PointQuery points(all_.skyline_, query);
      const PointAnswer point = points.AnswerAt(t);
      spent_ += points.counts().Sum();
      if (point.gave_up) break;
      if (!point.witness) {
        // What occludes one point is likely to occlude the next.
        likely_ = points.occluders();
        return point.occluded;
      }
      LowerAlong(point.witness->t, point.free_direction);
    }
    spent_ = std::max(spent_, limit_);
    return {};
  }

  // Requires: no occluder known so far rises above the edge, one step lower, on the line through t.
  // Adds an occluder that does so, or lowers the edge by the clearance.
  void LowerAlong(double t, const std::array<double, 2>& direction) {
    const Terrain& terrain = all_.terrain_;
    // A walk passes about a block of posts, as long as a decision, for so many columns and rows.
    constexpr std::int64_t kBlock = 8;
    spent_ += (terrain.dem().columns + terrain.dem().rows) / kBlock;
    const Point3i a = terrain.Point(edge_.a);
    const Point3i b = terrain.Point(edge_.b);
    const std::optional<HighestEdge> other = all_.lines_.HighestEdgeOver(
        edge_, a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), direction[0], direction[1]);
    const double own = a.z + t * (static_cast<double>(b.z) - a.z);
    const double clearance = other ? std::ldexp(own - other->height, all_.heights_.bits) : 0;
    if (clearance < depth_ + 1 && other &&
        AddVirtualOccluder({terrain.Point(other->edge.a), terrain.Point(other->edge.b)})) {
      return;
    }
    // The line query is rounded. Where the edge that it finds has been added before, the exact
    // answer counts: one step lower the edge is visible.
    depth_ = std::max(depth_ + 1, static_cast<std::int32_t>(clearance));
  }

  const SkylineDrops& all_;
  std::int32_t i_;
  Edge edge_;
  std::vector<Segment> virtual_occluders_;
  std::vector<std::int32_t> likely_;
  std::int32_t depth_ = 0;  // at which the edge is visible
  std::int64_t limit_;      // of decisions
  std::int64_t spent_ = 0;
};

SkylineDrops::SkylineDrops(const Terrain& terrain, const Horizon& horizon, double tolerance)
    : terrain_(terrain),
      horizon_(horizon),
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
  const std::int32_t depth = edge.FindDepth();
  if (edge.spent() >= limit) return {.quanta = std::nullopt, .spent = edge.spent()};
  return {.quanta = heights_.Quanta(depth), .spent = edge.spent()};
}

}  // namespace farhorizon
