// The edge is lowered, further and further, as long as it can be sighted over all others: each point of it
// that is in sight says by how much it may sink; each one that is not is hidden with a whole range around
// it, and stays so however low the edge gets. So every range is settled once.
//
// Of the other edges only those on the horizon are there from the start, those of the faces beside the edge,
// and what is known to hide it (Horizon::virtual occluders, which stand for ground as high as the edge's upper end, and
// so for ground that is not the edge's own). What comes to light where the edge sinks is found by walking
// along its lines of sight.
#include "core/horizon/lines_of_sight/skyline_drop.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "core/horizon/visibility/point_query.h"
#include "core/terrain/height_range.h"

namespace farhorizon {

// One edge on its way down.
class SkylineDrops::Sinking {
 public:
  Sinking(const SkylineDrops& all, std::size_t i)
      : all_(all), i_(static_cast<std::int32_t>(i)), edge_(all.horizon_.edges[i].edge) {
    const Horizon& horizon = all.horizon_;
    for (std::size_t j = i == 0 ? 0 : horizon.virtual_occluder_ends[i - 1];
         j < horizon.virtual_occluder_ends[i]; ++j) {
      AddVirtualOccluder(horizon.virtual_occluders[j]);
    }
    const Terrain::Faces faces = all.terrain_.FacesOf(edge_);
    for (const std::optional<VertexId> third : {faces.left, faces.right}) {
      if (!third) continue;
      AddVirtualOccluder({all.terrain_.Point(edge_.a), all.terrain_.Point(*third)});
      AddVirtualOccluder({all.terrain_.Point(edge_.b), all.terrain_.Point(*third)});
    }
  }

  // How deep it gets, in scaled units.
  std::int32_t Depth() {
    std::deque<OccludedRange> open = {
        {QuadraticRoot::At(Dyadic{0, 0}), QuadraticRoot::At(Dyadic{1, 0})}};
    while (!open.empty()) {
      const OccludedRange gap = open.front();
      open.pop_front();
      const std::optional<WideDyadic> t = Between(gap.from, gap.to);
      if (!t) continue;
      const OccludedRange hidden = Sink(*t);
      open.push_back({gap.from, hidden.from});
      open.push_back({hidden.to, gap.to});
    }
    return depth_;
  }

 private:
  // False where it is one already.
  bool AddVirtualOccluder(const Segment& segment) {
    Segment virtual_occluder = all_.Scaled(segment);
    if (virtual_occluder.a.z > virtual_occluder.b.z)
      std::swap(virtual_occluder.a, virtual_occluder.b);
    const auto same = [&virtual_occluder](const Segment& s) {
      return s.a == virtual_occluder.a && s.b == virtual_occluder.b;
    };
    if (std::any_of(virtual_occluders_.begin(), virtual_occluders_.end(), same)) return false;
    virtual_occluders_.push_back(virtual_occluder);
    return true;
  }

  // Lowers the edge until its point at t is out of sight; says what is hidden around it then.
  OccludedRange Sink(const WideDyadic& t) {
    for (;;) {
      const Segment own{all_.terrain_.Point(edge_.a), all_.terrain_.Point(edge_.b)};
      const Segment lowered = Lowered(all_.Scaled(own), depth_ + 1);
      const OcclusionHints hints{virtual_occluders_, likely_, std::nullopt};
      std::vector<std::int32_t> blockers;
      PointQuery search(all_.skyline_, lowered, Ties::kPass, i_, hints, &blockers, nullptr);
      const PointAnswer finding = search.LookAt(t);
      if (!finding.sight) {
        // What hides one point is likely to hide the next.
        likely_ = std::move(blockers);
        return finding.hidden;
      }
      Walk(finding.sight->t, finding.middle);
    }
  }

  // Along a line that nothing known hides from the edge one unit lower: finds what does, or lowers it.
  void Walk(double t, const std::array<double, 2>& direction) {
    const Terrain& terrain = all_.terrain_;
    const Point3i a = terrain.Point(edge_.a);
    const Point3i b = terrain.Point(edge_.b);
    const std::optional<HighestEdge> other = all_.walk_.HighestEdgeOver(
        edge_, a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), direction[0], direction[1]);
    const double own = a.z + t * (static_cast<double>(b.z) - a.z);
    const double clearance = other ? std::ldexp(own - other->height, all_.heights_.bits) : 0;
    if (clearance < depth_ + 1 && other &&
        AddVirtualOccluder({terrain.Point(other->edge.a), terrain.Point(other->edge.b)})) {
      return;
    }
    // Where the two disagree by what rounding does, the sight is right.
    depth_ = std::max(depth_ + 1, static_cast<std::int32_t>(clearance));
  }

  const SkylineDrops& all_;
  std::int32_t i_;
  Edge edge_;
  std::vector<Segment> virtual_occluders_;
  std::vector<std::int32_t> likely_;
  std::int32_t depth_ = 0;  // it is still seen at it
};

SkylineDrops::SkylineDrops(const Terrain& terrain, const Horizon& horizon, double tolerance)
    : terrain_(terrain),
      horizon_(horizon),
      walk_(terrain),
      heights_(FinerHeights::FromLeast(HeightRangeOf(terrain.dem()), tolerance)),
      skyline_(terrain.dem().columns, terrain.dem().rows) {
  for (const HorizonEdge& e : horizon.edges) {
    skyline_.Insert(Scaled({terrain.Point(e.edge.a), terrain.Point(e.edge.b)}));
  }
}

Segment SkylineDrops::Scaled(const Segment& segment) const {
  return {heights_.Scale(segment.a), heights_.Scale(segment.b)};
}

double SkylineDrops::Of(std::size_t i) const {
  if (horizon_.edges[i].undecided) return 0;
  return heights_.Quanta(Sinking(*this, i).Depth());
}

}  // namespace farhorizon
