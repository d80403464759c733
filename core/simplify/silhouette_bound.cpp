#include "core/simplify/silhouette_bound.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/geometry/plan.h"
#include "core/horizon/visibility/occluder_set.h"
#include "core/simplify/skyline_guard.h"

namespace farhorizon {
namespace {

constexpr std::size_t kEdgesBetweenChecks = 64;

/// Whether edge i, lowered by so many steps, is hidden.
using Hidden = std::function<bool(std::size_t i, std::int32_t steps)>;

class BoundSearch {
 public:
  BoundSearch(std::int32_t asked, std::int32_t most)
      : asked_(std::clamp(asked, 1, std::max(most, 1))), most_(most) {}

  /// Raises the bound until it hides each of `count` edges.
  Status Cover(std::size_t count, const Hidden& hidden, const Watch& watch) {
    // In scattered order: neighbours need about the same, and the bound settles after few searches.
    std::size_t stride = count * 5 / 8 + 1;
    while (std::gcd(stride, count) > 1) ++stride;
    std::size_t i = 0;
    for (std::size_t n = 0; n < count; ++n, i = (i + stride) % count) {
      if (n % kEdgesBetweenChecks == 0 && watch.StopRequested()) {
        return Error{ErrorCode::kCancelled, "stopped while measuring the silhouette"};
      }
      if (!hidden(i, bound_)) Raise(i, hidden);
    }
    return Done{};
  }

  [[nodiscard]] std::int32_t bound() const { return bound_; }

 private:
  void Raise(std::size_t i, const Hidden& hidden) {
    std::int64_t low = bound_;  // not enough
    // Never past what was asked for where that is enough: a level is seen to keep to its budget.
    std::int64_t high = low < asked_ ? asked_ : low + low / 16 + 1;
    while (high < most_ && !hidden(i, static_cast<std::int32_t>(high))) {
      low = high;
      high *= 2;
    }
    high = std::min<std::int64_t>(high, most_);  // hides everything: the whole relief
    while (high - low > std::max<std::int64_t>(high / 24, 1)) {
      const std::int64_t middle = low + (high - low) / 2;
      (hidden(i, static_cast<std::int32_t>(middle)) ? high : low) = middle;
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

bool MayCarrySkyline(const Terrain& terrain, const MeshEdge& e) {
  if (!e.left || !e.right) return true;
  return RidgeSign(terrain.Point(e.edge.a), terrain.Point(e.edge.b), terrain.Point(*e.left),
                   terrain.Point(*e.right)) > 0;
}

Result<double> SilhouetteBound(const Terrain& terrain, const Horizon& horizon,
                               const std::vector<MeshEdge>& edges, double asked,
                               const Watch& watch) {
  const SkylineGuard guard(terrain, horizon);
  const HeightScale& scale = guard.scale();
  BoundSearch search(scale.Steps(asked), scale.most_steps);

  // Above: what the DEM itself has as an edge cannot rise above it.
  OccluderSet occluders(terrain.dem().columns, terrain.dem().rows);
  std::vector<Edge> young;
  for (const MeshEdge& e : edges) {
    if (!MayCarrySkyline(terrain, e)) continue;
    occluders.Insert({scale.Scale(terrain.Point(e.edge.a)), scale.Scale(terrain.Point(e.edge.b))});
    if (!IsTerrainEdge(terrain, e.edge)) young.push_back(e.edge);
  }
  Status above = search.Cover(
      young.size(),
      [&](std::size_t i, std::int32_t steps) { return guard.Hides(young[i].a, young[i].b, steps); },
      watch);
  if (!above) return std::move(above.error());

  // Below: a horizon edge that the mesh has as an edge is not lost.
  std::vector<Segment> lost;
  for (const HorizonEdge& h : horizon.edges) {
    const auto found =
        std::lower_bound(edges.begin(), edges.end(), h.edge,
                         [](const MeshEdge& e, const Edge& edge) { return e.edge < edge; });
    if (found != edges.end() && found->edge == h.edge) continue;
    lost.push_back({scale.Scale(terrain.Point(h.edge.a)), scale.Scale(terrain.Point(h.edge.b))});
  }
  Status below = search.Cover(
      lost.size(),
      [&](std::size_t i, std::int32_t steps) {
        const Segment lowered = Lowered(lost[i], steps);
        return !occluders.FindLineOfSight({.segment = lowered, .ties = Ties::kBlock}).witness;
      },
      watch);
  if (!below) return std::move(below.error());
  return scale.Quanta(search.bound());
}

}  // namespace farhorizon
