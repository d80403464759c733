// Theorem S4 of core/simplify/README.md, both ways, with one bound for all edges. It starts at 0.
// Each edge that is visible when it is lowered by the present bound raises the bound, by doubling
// and bisection, until the edge is occluded. An edge that is occluded stays so when it is lowered
// further, so edges before it need not be looked at again.
// Cost: one visibility query for each edge, and some ten more for each edge that raises the bound.
#include "core/measure/silhouette_bound.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/horizon/guard/skyline_guard.h"
#include "core/horizon/visibility/occluder_set.h"

namespace farhorizon {

namespace {

constexpr std::size_t kEdgesBetweenChecks = 64;

// Whether edge i, lowered by so many steps, is occluded.
using IsOccluded = std::function<bool(std::size_t i, std::int32_t steps)>;

class BoundSearch {
 public:
  // asked: the value that is tried first. most: one that suffices for every edge.
  BoundSearch(std::int32_t asked, std::int32_t most)
      : asked_(std::clamp(asked, 1, std::max(most, 1))), most_(most) {}

  // Raises the bound until each of `count` edges, lowered by it, is occluded.
  Status Include(std::size_t count, const IsOccluded& occluded, const RunControl& control) {
    // In scattered order, by steps of five eighths of the whole: neighbouring edges need about the
    // same bound, so it is near its end after few edges. Any order is sound.
    std::size_t stride = count * 5 / 8 + 1;
    while (std::gcd(stride, count) > 1) ++stride;
    std::size_t i = 0;
    for (std::size_t n = 0; n < count; ++n, i = (i + stride) % count) {
      if (n % kEdgesBetweenChecks == 0 && control.StopRequested()) {
        return Error{ErrorCode::kCancelled, "stopped while measuring the silhouette"};
      }
      if (!occluded(i, bound_)) Raise(i, occluded);
    }
    return Ok{};
  }

  [[nodiscard]] std::int32_t bound() const { return bound_; }

 private:
  // Throughout, edge i is visible when lowered by `low`, and occluded when lowered by `high` once
  // the first loop has ended.
  void Raise(std::size_t i, const IsOccluded& occluded) {
    std::int64_t low = bound_;
    // The value that was asked for comes first, so that the bound does not exceed it where it can
    // be proven. Past it, steps of a sixteenth: what an edge lacks beyond the bound of the others
    // is mostly little.
    std::int64_t high = low < asked_ ? asked_ : low + low / 16 + 1;
    while (high < most_ && !occluded(i, static_cast<std::int32_t>(high))) {
      low = high;
      high *= 2;
    }
    high = std::min<std::int64_t>(high, most_);
    // Ends with high - low <= high / 24, so high <= low * 24 / 23: less than a twentieth above the
    // least value that can be proven. Any divisor is sound; a greater one takes more queries.
    while (high - low > std::max<std::int64_t>(high / 24, 1)) {
      const std::int64_t middle = low + (high - low) / 2;
      (occluded(i, static_cast<std::int32_t>(middle)) ? high : low) = middle;
    }
    bound_ = static_cast<std::int32_t>(high);
  }

  std::int32_t asked_;
  std::int32_t most_;
  std::int32_t bound_ = 0;
};

bool IsTerrainEdge(const Terrain& terrain, Edge edge) {
  const Point3i a = terrain.Point(edge.a);
  const Point3i b = terrain.Point(edge.b);
  if (std::abs(a.x - b.x) > 1 || std::abs(a.y - b.y) > 1) return false;
  const Terrain::Faces faces = terrain.FacesOf(edge);
  return faces.left || faces.right;
}

}  // namespace

Result<double> SilhouetteBound(const Terrain& terrain, const Horizon& horizon,
                               const std::vector<MeshEdge>& edges, double asked,
                               const RunControl& control) {
  const SkylineGuard guard(terrain, horizon);
  const FinerHeights& scale = guard.scale();
  BoundSearch search(scale.Steps(asked), scale.most_steps);

  // H of the mesh is not above that of the DEM. An edge of the mesh that is an edge of the DEM has
  // nothing to prove.
  OccluderSet occluders(terrain.dem().columns, terrain.dem().rows);
  std::vector<Edge> added;
  for (const MeshEdge& e : edges) {
    if (!terrain.IsRidgeOrBorder(e.edge, {e.left, e.right})) continue;
    occluders.Insert({scale.Scale(terrain.Point(e.edge.a)), scale.Scale(terrain.Point(e.edge.b))});
    if (!IsTerrainEdge(terrain, e.edge)) added.push_back(e.edge);
  }
  Status above = search.Include(
      added.size(),
      [&](std::size_t i, std::int32_t steps) {
        return guard.IsOccluded(added[i].a, added[i].b, steps);
      },
      control);
  if (!above) return std::move(above.error());

  // H of the mesh is not below that of the DEM. A horizon edge that is an edge of the mesh has
  // nothing to prove.
  std::vector<Segment> lost;
  for (const HorizonEdge& h : horizon.edges) {
    const auto found =
        std::lower_bound(edges.begin(), edges.end(), h.edge,
                         [](const MeshEdge& e, const Edge& edge) { return e.edge < edge; });
    if (found != edges.end() && found->edge == h.edge) continue;
    lost.push_back({scale.Scale(terrain.Point(h.edge.a)), scale.Scale(terrain.Point(h.edge.b))});
  }
  Status below = search.Include(
      lost.size(),
      [&](std::size_t i, std::int32_t steps) {
        const Segment lowered = Lowered(lost[i], steps);
        return !occluders.FindLineOfSight({.segment = lowered, .ties = Ties::kBlock}).witness;
      },
      control);
  if (!below) return std::move(below.error());
  return scale.Quanta(search.bound());
}

}  // namespace farhorizon
