#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/kinetic/hulls/step_marks.h"
#include "core/horizon/kinetic/hulls/sweep_depth.h"
#include "core/horizon/kinetic/inside_posts.h"
#include "core/horizon/kinetic/kinetic_horizon.h"
#include "core/terrain/terrain.h"

namespace farhorizon::kinetic {

/// The sweep plane falling through the terrain, post by post, and the scene of hulls and tangents
/// that is kept in it ([Archambault03] algorithm 3.1).
///
/// Scene: NeighbourScene or BitangentScene.
template <typename Scene>
class KineticSweep {
 public:
  /// checks: whether all invariants of the scene are checked after every step. Requires: `terrain`
  /// and `control` outlive it.
  KineticSweep(const Terrain& terrain, const RunControl& control, const KineticOptions& options,
               bool checks = false);

  /// Goes down to depth `last`, its own events included; to the bottom by default. Call it once.
  /// Errors: those of FindHorizonKinetic.
  Status Run(std::int64_t last = kNever);

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] std::int32_t summit() const { return summit_; }
  [[nodiscard]] std::int32_t lowest() const { return Height(order_.back()); }

  /// The edges that were on the horizon down to here, and what was counted. Call it once, at the
  /// end.
  KineticHorizon Take();

 private:
  [[nodiscard]] std::int32_t Height(VertexId v) const { return terrain_.Point(v).z; }
  [[nodiscard]] std::int64_t DepthOf(VertexId v) const { return std::int64_t{summit_} - Height(v); }
  [[nodiscard]] bool Fits() const;
  [[nodiscard]] bool OverBudget() const;
  [[nodiscard]] bool MustStop() const;
  [[nodiscard]] Error Stopped() const;
  bool SinkTo(std::int64_t s);
  bool SinkPast(std::int64_t last);
  bool MayGoOn();
  void Report(double done);
  void RestoreInvariants();
  void FindHorizontalEdges(std::size_t next, std::size_t end, std::int64_t s);
  void PassPosts(std::size_t next, std::size_t end, std::int64_t s);
  [[nodiscard]] bool HasHigherNeighbour(VertexId v) const;
  void Connect(VertexId v, ClusterId containing);
  void Continue(VertexId v, std::int64_t s);

  const Terrain& terrain_;
  const RunControl& control_;
  double reported_ = 0;
  std::int64_t work_budget_;
  HullCertificates hull_certificates_;
  bool checks_;
  Scene scene_;
  InsidePosts<Scene> inside_;
  std::int32_t summit_ = 0;
  std::vector<VertexId> order_;        // from the summit down
  std::vector<ClusterId> cluster_;     // per post; -1 below the plane
  std::vector<PointId> arriving_;      // per post: the last point whose edge ends there
  std::vector<PointId> arriving_too_;  // per point: the one before it; -1
  std::vector<ClusterId> containing_;  // of PassPosts()
  std::vector<Edge> edges_;            // by tag
  EventCounts events_;
  KineticHorizon result_;
};

}  // namespace farhorizon::kinetic
