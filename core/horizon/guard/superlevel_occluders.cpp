// Posts are added in descending order of height, and the connected components of the ground that
// has been added are kept by union and find, each with its extreme posts in eight directions. At
// each of kHeights heights every component gives up to four segments between opposite extremes.
#include "core/horizon/guard/superlevel_occluders.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <limits>

#include "core/geometry/union_find.h"

namespace farhorizon {

namespace {

// Any counts are sound, as every segment is a virtual occluder. With more heights there is one
// closer below each target; short segments occlude little and slow every query.
constexpr std::size_t kHeights = 64;
constexpr std::int32_t kLeastExtent = 5;  // columns or rows

// The extreme posts of a component: least and greatest x, y, x + y, x - y.
using Extremes = std::array<VertexId, 8>;

// The connected components of the posts that have been added.
class Components {
 public:
  explicit Components(const Terrain& terrain)
      : terrain_(terrain),
        parent_(static_cast<std::size_t>(terrain.post_count()), -1),
        extremes_(static_cast<std::size_t>(terrain.post_count())) {}

  void Add(VertexId v) {
    parent_[Index(v)] = v;
    extremes_[Index(v)].fill(v);
    roots_.push_back(v);
    for (const VertexId n : terrain_.NeighboursOf(v)) {
      if (parent_[Index(n)] >= 0) Join(v, n);
    }
  }

  // All posts added so far are at `height` or above.
  void AppendOccluders(std::int32_t height, std::vector<Segment>& occluders) {
    std::erase_if(roots_, [this](VertexId v) { return parent_[Index(v)] != v; });
    for (const VertexId root : roots_) {
      const Extremes& e = extremes_[Index(root)];
      for (std::size_t k = 0; k < 8; k += 2) {
        Point3i a = terrain_.Point(e[k]);
        Point3i b = terrain_.Point(e[k + 1]);
        if (std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) < kLeastExtent) continue;
        a.z = b.z = height;
        occluders.push_back({a, b});
      }
    }
  }

 private:
  static std::size_t Index(VertexId v) { return static_cast<std::size_t>(v); }

  VertexId Root(VertexId v) { return FindRoot(parent_, v); }

  void Join(VertexId p, VertexId q) {
    p = Root(p);
    q = Root(q);
    if (p == q) return;
    parent_[Index(q)] = p;
    for (std::size_t k = 0; k < 8; ++k) {
      VertexId& ours = extremes_[Index(p)][k];
      const VertexId theirs = extremes_[Index(q)][k];
      const std::int32_t difference = Reach(theirs, k / 2) - Reach(ours, k / 2);
      if (k % 2 == 0 ? difference < 0 : difference > 0) ours = theirs;
    }
  }

  [[nodiscard]] std::int32_t Reach(VertexId v, std::size_t direction) const {
    const std::int32_t x = terrain_.dem().Column(v);
    const std::int32_t y = terrain_.dem().Row(v);
    const std::array<std::int32_t, 4> reach = {x, y, x + y, x - y};
    return reach[direction];
  }

  const Terrain& terrain_;
  std::vector<VertexId> parent_;  // -1: not added
  std::vector<Extremes> extremes_;
  std::vector<VertexId> roots_;  // some have been joined to others since
};

}  // namespace

std::vector<Segment> SuperlevelOccluders(const Terrain& terrain,
                                         std::vector<std::int32_t> heights) {
  std::vector<Segment> occluders;
  if (heights.empty()) return occluders;
  std::sort(heights.begin(), heights.end(), std::greater<>());
  std::vector<VertexId> order;
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (terrain.IsVertex(v)) order.push_back(v);
  }
  std::sort(order.begin(), order.end(), [&terrain](VertexId p, VertexId q) {
    const std::int32_t at_p = terrain.Point(p).z;
    const std::int32_t at_q = terrain.Point(q).z;
    return at_p > at_q || (at_p == at_q && p < q);
  });
  Components components(terrain);
  std::size_t next = 0;
  std::int32_t last = std::numeric_limits<std::int32_t>::max();
  for (std::size_t i = 0; i < kHeights; ++i) {
    const std::int32_t height = heights[i * heights.size() / kHeights];
    if (height == last) continue;
    last = height;
    while (next < order.size() && terrain.Point(order[next]).z >= height) {
      components.Add(order[next++]);
    }
    components.AppendOccluders(height, occluders);
  }
  return occluders;
}

}  // namespace farhorizon
