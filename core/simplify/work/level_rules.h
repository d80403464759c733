#pragma once

#include <cstdint>
#include <vector>

#include "core/horizon/guard/skyline_guard.h"
#include "core/horizon/horizon.h"
#include "core/simplify/mesh/half_edge_mesh.h"
#include "core/terrain/part_grid.h"

namespace farhorizon {

/// What no price buys.
///
/// At an exact level: the ends of horizon edges stay at their posts and heights, horizon edges are
/// not flipped, no new edge rises above the DEM's skyline. At every level: a horizon edge that the
/// finer level does not have does not come back; no edge crosses a line along which the level is to
/// be cut into parts. None does at first, so such a line is covered by edges all along.
class LevelRules {
 public:
  /// Requires: all outlive it.
  LevelRules(const Ground& ground, const Horizon& horizon);

  /// rise_m: by how much an edge may rise above the skyline all the same.
  void BeginExact(double rise_m);
  /// Whether an exact level's new edges are allowed unasked, until somebody asks Rises.
  void Trust(bool trust) { trusts_ = trust; }
  /// mesh: the finer level, whose horizon edges may stay.
  void BeginSoft(const HalfEdgeMesh& mesh);

  /// Where no new edge may cross from now on. Requires: no edge crosses a line.
  void Cut(const PartGrid& parts) { parts_ = parts; }
  [[nodiscard]] const PartGrid& parts() const { return parts_; }

  /// Whether the level is an exact one, but for the rises that it was allowed.
  [[nodiscard]] bool exact() const { return exact_; }
  [[nodiscard]] bool allows_rises() const { return !exact_ || rise_steps_ > 0; }
  /// Whether v must not be changed at all.
  [[nodiscard]] bool IsLocked(std::int32_t v) const {
    return exact_ && locked_[static_cast<std::size_t>(v)];
  }
  /// Whether the edge between two places is one of the DEM's horizon edges and must stay.
  [[nodiscard]] bool MustStay(const Place& p, const Place& q) const {
    return exact_ && Has(p, q, 0);
  }
  /// Whether a new edge, or an old one at new heights, is allowed.
  [[nodiscard]] bool Allows(const Place& p, const Place& q) const;
  /// Whether the edge rises above the DEM's skyline by more than it may.
  /// likely: occluders that are tried first; those of the last edge that took a search.
  [[nodiscard]] bool Rises(const Place& p, const Place& q, std::vector<OccluderId>& likely) const {
    return !guard_.IsOccluded(LoweredEdge(p, q), likely);
  }
  /// The same for the edge between the places i and j of a ring that is to take the place of spokes
  /// from `centre`. Asks first whether it runs below them: then it does not rise above the skyline,
  /// as they do not.
  [[nodiscard]] bool AllowsChord(const Ring& ring, const Place& centre, std::int32_t i,
                                 std::int32_t j) const;
  /// The same for an edge to `other` whose end goes from one place to another. Refuses what only a
  /// search could allow: polish gains less than that costs.
  [[nodiscard]] bool AllowsMove(const Place& from, const Place& to, const Place& other) const;
  /// A place's height as the rules and the level's mesh have it, metres: the post's own, or the
  /// nearest step of the guard's scale.
  [[nodiscard]] double HeightM(const Place& place) const;
  /// The horizon edges that are edges of `mesh`, by their index, rising; without those that the
  /// finer level does not have, which HalfEdgeMesh::CutOff may have made again.
  [[nodiscard]] std::vector<std::int32_t> KeptIn(const HalfEdgeMesh& mesh) const;

 private:
  [[nodiscard]] Point3i Scaled(const Place& place) const;
  [[nodiscard]] Segment LoweredEdge(const Place& p, const Place& q) const {
    return Lowered({Scaled(p), Scaled(q)}, rise_steps_);
  }
  [[nodiscard]] bool IsBarred(const Place& p, const Place& q) const {
    return parts_.IsCrossedBy(p.x, p.y, q.x, q.y) || Has(p, q, 1);
  }
  [[nodiscard]] bool IsOccluded(const Place& p, const Place& q) const;
  [[nodiscard]] bool RunsBelow(const Ring& ring, const Place& centre, std::int32_t i,
                               std::int32_t j) const;
  // Bit 0: whether there is such a horizon edge; bit 1: whether it is barred.
  [[nodiscard]] bool Has(const Place& p, const Place& q, int bit) const;
  [[nodiscard]] std::uint8_t* FlagsOf(VertexId p, VertexId q, int& shift);

  const Ground* ground_;
  const Horizon* horizon_;
  SkylineGuard guard_;
  PartGrid parts_;
  bool exact_ = false;
  bool trusts_ = false;
  std::int32_t rise_steps_ = 0;
  std::vector<bool> locked_;  // per post
  // Per block of posts: what occluded the last edge there that took a search.
  mutable std::vector<std::vector<OccluderId>> likely_;
  std::vector<std::uint8_t> edges_;  // per post: two bits for each direction to a later post
};

}  // namespace farhorizon
