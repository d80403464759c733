#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/horizon/kinetic/hulls/hull_location.h"
#include "core/horizon/kinetic/hulls/step_marks.h"
#include "core/terrain/terrain.h"

namespace farhorizon::kinetic {

/// Which cluster's hull surely has a post inside. Hulls only grow, and clusters only join: so what
/// was found once stays, and is kept for each post.
///
/// Scene: NeighbourScene or BitangentScene.
template <typename Scene>
class InsidePosts {
 public:
  /// Requires: `terrain` and `scene` outlive it.
  InsidePosts(const Terrain& terrain, const Scene& scene)
      : terrain_(terrain),
        scene_(scene),
        inside_(static_cast<std::size_t>(terrain.post_count()), -1) {}

  /// Whether the hull of cluster c surely has the post inside at depth s.
  bool IsInside(VertexId v, ClusterId c, std::int64_t s) {
    ClusterId& inside = inside_[static_cast<std::size_t>(v)];
    if (inside >= 0 && scene_.Find(inside) == scene_.Find(c)) return true;
    const Point3i post = terrain_.Point(v);
    if (!SurelyInsideAt(scene_.hulls(), c, post.x, post.y, s)) return false;
    inside = c;
    return true;
  }

  /// The cluster whose hull surely has the post inside at depth s; -1: none is sure to.
  /// work: the clusters that are looked at are added.
  ClusterId ClusterAround(VertexId v, std::int64_t s, std::int64_t& work) {
    ClusterId& inside = inside_[static_cast<std::size_t>(v)];
    if (inside >= 0) return scene_.Find(inside);
    const Point3i post = terrain_.Point(v);
    work += static_cast<std::int64_t>(scene_.hulls().clusters().size());
    for (const ClusterId c : scene_.hulls().clusters()) {
      if (scene_.box(c).Contains(post.x, post.y) &&
          SurelyInsideAt(scene_.hulls(), c, post.x, post.y, s)) {
        return inside = c;
      }
    }
    return -1;
  }

 private:
  const Terrain& terrain_;
  const Scene& scene_;
  std::vector<ClusterId> inside_;  // per post; -1: not known
};

}  // namespace farhorizon::kinetic
