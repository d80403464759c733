#pragma once

#include <cstdint>
#include <vector>

#include "core/simplify/lines/sampled_skyline.h"
#include "core/simplify/lines/visual_hull.h"
#include "core/simplify/mesh/ring.h"
#include "core/simplify/mesh/squares.h"

namespace farhorizon {

/// What a change around one vertex does to the sampled skyline, in the square metres of the sum
/// that the simplifier makes least:
///   sum over posts (f' - f)^2 + weight * sum over lines (H' - H)^2.
/// Two kinds of lines change: those that the vertex's edges carry, which it may lose, and those
/// above whose top a new edge rises.
class SkylinePrice {
 public:
  /// What a rise costs where none is allowed: more than anything else.
  static constexpr float kForbidden = 1e30F;

  /// Requires: both outlive it.
  SkylinePrice(const HalfEdgeMesh& mesh, SampledSkyline& skyline);

  /// Square metres over posts that a square metre over one line is worth.
  void SetWeight(float weight) { weight_ = weight; }
  /// Whether an edge may rise above a line's top at all.
  void AllowRises(bool allow) { allow_rises_ = allow; }

  /// Starts on vertex v: forgets what it carried once. Returns the most that a change could win
  /// back on the lines that it carries.
  float Begin(std::int32_t v);
  /// Finds what those lines would have without the vertex's edges. Requires: Begin(ring.centre).
  void FindLost(const Ring& ring);
  [[nodiscard]] bool LosesNone() const { return lost_.empty(); }
  /// The change on those lines if the ring is filled with spokes from `hub`, to all neighbours but
  /// those joined to j; j: the hub's place in the ring, -1: inside it. Requires: FindLost(ring).
  [[nodiscard]] float ChangeOfLost(const Ring& ring, const Place& hub, std::int32_t j) const;
  /// Adds what the lines that v carries ask of its height. Requires: FindLost(ring).
  void AddPullOfLines(const Ring& ring, const Place& centre, HeightPull& pull) const;

  /// The change by a new edge, on lines that Begin has not marked.
  [[nodiscard]] float RiseOf(const Place& a, const Place& b) const;
  [[nodiscard]] bool MayRiseAround(const Ring& ring, const Place& centre) const {
    return hull_.MayRiseAround(centre, ring.place.data(), ring.count);
  }
  [[nodiscard]] bool MayRise(const Place& a, const Place& b) const { return hull_.MayRise(a, b); }

  /// A flip takes the edge from a to c away, sides 0 and 2 of the ring (a, d, c, b), and joins the
  /// others. Marks the lines that the edge carries; returns the most that they could win back.
  float BeginFlip(const Ring& quad);
  [[nodiscard]] float ChangeOfFlip(const Ring& quad) const;

  /// The upkeep after a change: lines that were lost have the ring's outline and its new spokes.
  void RestoreLost(const Ring& ring, std::int32_t hub, std::int32_t j);
  void RestoreFlipped(const Ring& quad);
  /// The same for all lines that a vertex carried which is gone.
  template <typename Touch>
  void RestoreAfterCollapse(const Ring& ring, std::int32_t hub, std::int32_t j, Touch touch);

 private:
  struct Lost {
    std::int32_t line;
    float rest;    // the greatest height without the vertex's edges
    float square;  // of the present error
  };

  void KeepAround(std::int32_t line, const Ring& ring, std::int32_t hub, std::int32_t j);

  const HalfEdgeMesh* mesh_;
  SampledSkyline* skyline_;
  VisualHull hull_;
  float weight_ = 0;
  bool allow_rises_ = true;
  Table<std::int32_t> mark_;  // per line: the Begin that marked it last
  std::int32_t now_ = 0;
  std::vector<Lost> lost_;
  std::vector<float> distances_;  // of the ring's places from each lost line
  std::vector<std::int32_t> flipped_;
  std::vector<std::int32_t> taken_;
};

template <typename Touch>
void SkylinePrice::RestoreAfterCollapse(const Ring& ring, std::int32_t hub, std::int32_t j,
                                        Touch touch) {
  skyline_->carried().Take(ring.centre, taken_);
  for (const std::int32_t line : taken_) {
    if (!skyline_->Carries(line, ring.centre) || !skyline_->Counts(line)) continue;
    skyline_->Refresh(line);
    KeepAround(line, ring, hub, j);
    touch(skyline_->Best(line).a);
    touch(skyline_->Best(line).b);
  }
}

}  // namespace farhorizon
