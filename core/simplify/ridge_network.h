#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/run_control.h"
#include "core/geometry/finer_heights.h"
#include "core/horizon/horizon.h"
#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Edges of a mesh, called ridges, that keep its skyline from sinking: at first all horizon edges
/// of the DEM, later also edges that replace several of them.
///
/// Invariant: every horizon edge of the DEM, lowered by the allowance, is occluded by the network.
/// So H of any mesh that has the network's edges is at most the allowance below H of the DEM
/// (core/simplify/README.md, theorem S4 with the roles exchanged). For each horizon edge the
/// network keeps a certificate: ridges that occlude it. When a ridge of a certificate is removed,
/// the horizon edge is proven to be occluded again, by ridges nearby. (Ridges far away would prove
/// more, but such a proof takes some thirty times as long and its certificate has a hundred
/// ridges.)
///
///      p ----- v ----- q        Moving v onto b removes the ridges pv, vq and vb and inserts pb
///              |                and bq. Horizon edges with one of the three in their certificate,
///              b                their dependents, need a new one.
class RidgeNetwork {
 public:
  /// The allowance is 0 at first: no ridge may be removed. Requires: both outlive the network.
  RidgeNetwork(const Terrain& terrain, const Horizon& horizon, FinerHeights scale);

  /// Requires: no less than before, so that what is proven stays proven.
  void Allow(std::int32_t steps) { allowance_ = steps; }

  /// Removes ridges one end of which meets no other ridge, lowest first, while the invariant holds.
  /// Ends early, with the invariant intact, if the control requests a stop.
  /// Cost: one visibility query for each dependent of a ridge tried.
  void PruneLeaves(const RunControl& control);

  /// Whether a post may be moved onto its neighbour: one on no ridge may, another along a ridge.
  [[nodiscard]] bool MayMove(VertexId v, VertexId b) const;
  /// Replaces the ridges at `v` by ridges at `b`. False, and nothing is changed, where a horizon
  /// edge would become visible. Requires: MayMove(v, b).
  bool Move(VertexId v, VertexId b);

 private:
  using RidgeId = std::int32_t;
  struct Ridge {
    Edge edge;
    bool in_network = false;
    // Horizon edges that have this ridge in their certificate, or had it.
    std::vector<std::int32_t> dependents;
  };

  RidgeId Add(Edge edge);
  void Insert(RidgeId ridge);
  void Remove(RidgeId ridge);
  [[nodiscard]] bool HasRidge(Edge edge) const;
  [[nodiscard]] VertexId OtherEnd(RidgeId ridge, VertexId v) const;
  // Replaces `old` by `replacements` if all dependents of the old can be proven without them.
  bool Replace(std::span<const RidgeId> old, const std::vector<Edge>& replacements);
  // Tries to prove that the horizon edge, lowered by the allowance, is occluded, and keeps the
  // certificate. replacements: ridges inserted for ridges of the old certificate.
  bool Prove(std::int32_t horizon_edge, std::span<const RidgeId> replacements);
  bool ProveNearby(std::int32_t horizon_edge, const Segment& lowered,
                   std::span<const RidgeId> replacements);
  [[nodiscard]] Segment Scaled(Edge edge) const;
  [[nodiscard]] std::vector<std::int32_t> DependentsOf(std::span<const RidgeId> ridges) const;

  const Terrain* terrain_;
  const Horizon* horizon_;
  FinerHeights scale_;
  OccluderSet nothing_;  // stays empty: over it, virtual occluders alone decide
  std::int32_t allowance_ = 0;
  std::vector<Ridge> ridges_;
  std::vector<std::vector<RidgeId>> certificates_;                // per horizon edge, rising
  std::unordered_map<VertexId, std::vector<RidgeId>> ridges_of_;  // only looked up, never walked
  std::vector<Segment> virtual_occluders_;
};

}  // namespace farhorizon
