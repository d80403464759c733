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
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/horizon/visibility/point_query.h"

namespace farhorizon {
namespace {

// A lowered segment stays above minus the range of heights: both are within OccluderSet's limits.
constexpr int kHeightBits = 29;

std::pair<std::int32_t, std::int32_t> RangeOf(const Dem& dem) {
  std::int32_t lowest = std::numeric_limits<std::int32_t>::max();
  std::int32_t highest = std::numeric_limits<std::int32_t>::min();
  for (const std::int32_t height : dem.heights) {
    if (height == kNoHeight) continue;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  return {lowest, highest};
}

}  // namespace

// One edge on its way down.
class SkylineDrops::Sinking {
 public:
  Sinking(const SkylineDrops& all, std::size_t i)
      : all_(all), i_(static_cast<std::int32_t>(i)), edge_(all.horizon_.edges[i].edge) {
    const Horizon& horizon = all.horizon_;
    for (const Segment& segment : horizon.virtual_occluders.Of(i)) AddVirtualOccluder(segment);
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
    Segment virtual_occluder{all_.Scaled(segment.a), all_.Scaled(segment.b)};
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
      Segment lowered{all_.Scaled(all_.terrain_.Point(edge_.a)),
                      all_.Scaled(all_.terrain_.Point(edge_.b))};
      lowered.a.z -= depth_ + 1;
      lowered.b.z -= depth_ + 1;
      const VisibilityQuery query{
          .segment = lowered,
          .except = i_,
          .hints = {.virtual_occluders = virtual_occluders_, .likely = likely_}};
      PointQuery points(all_.skyline_, query);
      const PointAnswer point = points.AnswerAt(t);
      if (!point.witness) {
        // What hides one point is likely to hide the next.
        likely_ = points.occluders();
        return point.occluded;
      }
      Walk(point.witness->t, point.free_direction);
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
    const double clearance = other ? std::ldexp(own - other->height, all_.bits_) : 0;
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
      skyline_(terrain.dem().columns, terrain.dem().rows) {
  const auto [lowest, highest] = RangeOf(terrain.dem());
  lowest_ = lowest;
  const int span_bits = std::ilogb(std::max(1.0, static_cast<double>(highest) - lowest)) + 1;
  bits_ = std::min(static_cast<int>(std::ceil(-std::log2(tolerance))), kHeightBits - span_bits);
  for (const HorizonEdge& e : horizon.edges) {
    skyline_.Insert({Scaled(terrain.Point(e.edge.a)), Scaled(terrain.Point(e.edge.b))});
  }
}

Point3i SkylineDrops::Scaled(Point3i p) const {
  const double height = static_cast<double>(p.z) - lowest_;
  return {p.x, p.y, static_cast<std::int32_t>(std::nearbyint(std::ldexp(height, bits_)))};
}

double SkylineDrops::Of(std::size_t i) const {
  if (horizon_.edges[i].undecided) return 0;
  return std::ldexp(Sinking(*this, i).Depth(), -bits_);
}

}  // namespace farhorizon
