#pragma once

#include <cstdint>
#include <vector>

#include "core/base/run_control.h"
#include "core/simplify/lines/sampled_skyline.h"
#include "core/simplify/mesh/half_edge_mesh.h"
#include "core/simplify/prices/skyline_price.h"
#include "core/simplify/work/bucket_queue.h"
#include "core/simplify/work/level_rules.h"

namespace farhorizon {

/// What all steps of simplifying work on: the mesh, the skyline that it has, what may be done to
/// it, and the vertices that wait to be collapsed.
struct Workpiece {
  /// Requires: both outlive it.
  Workpiece(const Ground& on_ground, const Horizon& horizon, std::int32_t directions)
      : ground(on_ground),
        mesh(on_ground),
        skyline(mesh, horizon, directions),
        price(mesh, skyline),
        rules(on_ground, horizon),
        stays(static_cast<std::size_t>(mesh.vertices()), false),
        queued(static_cast<std::size_t>(mesh.vertices()), false),
        stale(static_cast<std::size_t>(mesh.vertices()), false) {}
  Workpiece(const Workpiece&) = delete;
  Workpiece& operator=(const Workpiece&) = delete;

  /// Marks a vertex whose surroundings have changed: it is rated anew when its turn comes.
  void Touch(std::int32_t v, std::int32_t bucket) {
    stale[static_cast<std::size_t>(v)] = true;
    if (!queued[static_cast<std::size_t>(v)]) Enqueue(v, bucket);
  }
  void Enqueue(std::int32_t v, std::int32_t bucket) {
    queued[static_cast<std::size_t>(v)] = true;
    queue.Add(v, bucket);
  }
  /// Whether v's place may be changed by price: not what rules, rims or sides hold.
  [[nodiscard]] bool IsFree(std::int32_t v) const {
    return mesh.IsVertex(v) && !mesh.IsKnotted(v) && !rules.IsLocked(v);
  }
  /// Moves the ring's centre, and brings up to date what that touches.
  /// Requires: Begin and FindLost of `price` on that ring; no triangle flips.
  void Put(const Ring& ring, const Place& place);

  const Ground& ground;
  HalfEdgeMesh mesh;
  SampledSkyline skyline;
  SkylinePrice price;
  LevelRules rules;
  BucketQueue queue;
  std::vector<bool> stays;   // per vertex: not to be collapsed at this level
  std::vector<bool> queued;  // per vertex
  std::vector<bool> stale;   // per vertex: what it costs is not known any more
};

/// A step of simplifying looks for a request to stop after so many vertices.
inline constexpr std::int32_t kVerticesBetweenChecks = 1024;

}  // namespace farhorizon
