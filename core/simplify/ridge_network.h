#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/progress.h"
#include "core/geometry/finer_heights.h"
#include "core/horizon/horizon.h"
#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The edges of a mesh that hold its skyline up: at first all horizon edges, later chords of ridges.
///
/// Invariant: every horizon edge of the DEM, lowered by the allowance, is hidden behind the network;
/// so H of any mesh that has the network's edges is at most the allowance below H of the DEM. Each
/// horizon edge keeps the ridges that hide it, its certificate, and is proven anew when one goes, by
/// ridges nearby. (Far ones could hide more, but such a proof takes some thirty times as long and leans
/// on a hundred ridges.)
class RidgeNetwork {
 public:
  /// Requires: both outlive the network. The allowance is 0: nothing may go.
  RidgeNetwork(const Terrain& terrain, const Horizon& horizon, FinerHeights scale);

  /// Requires: no less than before, so that what is proven stays proven.
  void Allow(std::int32_t steps) { allowance_ = steps; }

  /// Drops ridges from their loose ends, lowest first, as far as the allowance goes.
  /// Leaves off where the watch says stop.
  /// Cost: a sight for each horizon edge that leaned on a ridge tried.
  void PruneLeaves(const Watch& watch);

  [[nodiscard]] bool Has(VertexId v) const { return ridges_of_.count(v) > 0; }
  /// Whether a post may move onto its neighbour: any that is on no ridge, others along a ridge.
  [[nodiscard]] bool MayMove(VertexId v, VertexId b) const;
  /// Takes the ridges of `v` along to `b`; false, and nothing changed, where a horizon edge would
  /// come into sight. Requires: MayMove(v, b).
  bool Move(VertexId v, VertexId b);

  /// The ridges as they stand.
  [[nodiscard]] std::vector<Edge> Edges() const;

 private:
  using RidgeId = std::int32_t;
  struct Ridge {
    Edge edge;
    bool stands = false;
    std::vector<std::int32_t>
        leaning;  // horizon edges with this ridge in their certificate, or once
  };

  RidgeId Add(Edge edge);
  void Stand(RidgeId ridge);
  void Fall(RidgeId ridge);
  [[nodiscard]] bool HasRidge(Edge edge) const;
  [[nodiscard]] VertexId OtherEnd(RidgeId ridge, VertexId v) const;
  // Puts `young` in the place of `old` if all that leaned on the old can be proven without them.
  bool Replace(std::span<const RidgeId> old, const std::vector<Edge>& young);
  // Proves that the horizon edge, lowered by the allowance, is hidden, and notes by which ridges.
  // young: ridges that have come in the place of some that hid it.
  bool Prove(std::int32_t horizon_edge, std::span<const RidgeId> young);
  bool ProveNearby(std::int32_t horizon_edge, const Segment& lowered,
                   std::span<const RidgeId> young);
  [[nodiscard]] Segment Scaled(Edge edge) const;
  [[nodiscard]] std::vector<std::int32_t> LeaningOn(std::span<const RidgeId> ridges) const;

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
