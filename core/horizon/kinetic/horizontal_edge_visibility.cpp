// A set of visual lines that cross a horizontal edge is an open subset of the strip (edge) x
// (directions), so it is met at all but finitely many points of the edge over which it lies: at
// those just after the places where the walk stops, too (theorem 8 of core/horizon/README.md).
// The walk ends: it stops where one of finitely many triples of points comes in line.
#include "core/horizon/kinetic/horizontal_edge_visibility.h"

#include <algorithm>

#include "core/horizon/kinetic/bitangents/bitangent_scene.h"
#include "core/horizon/kinetic/neighbours/free_line.h"
#include "core/horizon/kinetic/neighbours/line_pencil.h"
#include "core/horizon/kinetic/neighbours/neighbour_scene.h"

namespace farhorizon::kinetic {

namespace {

constexpr std::int64_t kEndOfEdge = 1;

bool IsPlaced(const SweepDepth& at) { return at.hi - at.lo < PlanBox::kMargin / 2; }

double PlaceAlong(std::int64_t from, std::int64_t step, const SweepDepth& at) {
  return static_cast<double>(from) + static_cast<double>(step) * at.lo;
}

}  // namespace

template <typename Scene>
const PlanBox& HorizontalEdgeVisibility<Scene>::box(ClusterId c) const {
  return scene_.box(scene_.hulls().clusters()[Index(c)]);
}

// The hull that contains the point just after now, on its border or inside.
template <typename Scene>
std::optional<ClusterId> HorizontalEdgeVisibility<Scene>::HullAround(const MovingPoint& p) const {
  const double x = PlaceAlong(p.x, p.vx, hulls_.now());
  const double y = PlaceAlong(p.y, p.vy, hulls_.now());
  const bool is_placed = IsPlaced(hulls_.now());
  for (const ClusterId c : hulls_.clusters()) {
    if (is_placed && !box(c).Contains(x, y)) continue;
    const std::vector<PointId>& ring = hulls_.corners(c);
    std::size_t i = 0;
    while (i < ring.size() &&
           OrientAfter(hulls_.path(ring[i]), hulls_.path(ring[(i + 1) % ring.size()]), p,
                       hulls_.now()) >= 0) {
      ++i;
    }
    if (i == ring.size()) return c;
  }
  return std::nullopt;
}

// Where the point leaves the hull; nullopt: not before the end of the edge.
template <typename Scene>
std::optional<SweepDepth> HorizontalEdgeVisibility<Scene>::WayOutOf(ClusterId c,
                                                                    const MovingPoint& p) const {
  const std::vector<PointId>& ring = hulls_.corners(c);
  std::optional<SweepDepth> first;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::optional<SweepDepth> at =
        TurnFailureAfter({hulls_.path(ring[i]), hulls_.path(ring[(i + 1) % ring.size()]), p}, 1,
                         hulls_.now(), kEndOfEdge);
    if (at && (!first || Compare(*at, *first) < 0)) first = at;
  }
  return first;
}

template <typename Scene>
bool HorizontalEdgeVisibility<Scene>::IsVisible(Point3i a, Point3i b) {
  const MovingPoint behind = MovingPoint::Standing(a.x, a.y);
  const MovingPoint p{a.x, std::int64_t{b.x} - a.x, a.y, std::int64_t{b.y} - a.y, 1};
  std::optional<SweepDepth> at = SweepDepth::At(0);
  while (at) {
    hulls_.AdvanceTo(*at);
    looks_ += static_cast<std::int64_t>(hulls_.clusters().size());
    if (const std::optional<ClusterId> around = HullAround(p)) {
      at = WayOutOf(*around, p);
      continue;
    }
    LinePencil<FrozenHulls> pencil(hulls_, p, behind);
    for (const ClusterId c : recent_) {
      if (!pencil.Has(c)) pencil.Add(c);
    }
    const FreeLineQuery query{hulls_.clusters(), -1, PlaceAlong(p.x, p.vx, *at),
                              PlaceAlong(p.y, p.vy, *at), IsPlaced(*at)};
    const auto box_of = [this](ClusterId c) -> const PlanBox& { return box(c); };
    if (FindFreeLine(pencil, query, box_of, looks_)) return true;
    recent_ = pencil.cover();
    at = pencil.FailureBefore(kEndOfEdge);
  }
  return false;
}

template class HorizontalEdgeVisibility<NeighbourScene>;
template class HorizontalEdgeVisibility<BitangentScene>;

}  // namespace farhorizon::kinetic
