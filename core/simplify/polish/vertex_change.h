#pragma once

#include "core/simplify/mesh/squares.h"
#include "core/simplify/work/workpiece.h"

namespace farhorizon {

/// A change of one vertex's place, its neighbours staying: what it costs, whether it is allowed.
class VertexChange {
 public:
  explicit VertexChange(Workpiece& work) : work_(work) {}

  /// Looks at v. false: it has too many neighbours.
  bool Begin(std::int32_t v);
  [[nodiscard]] const Ring& ring() const { return ring_; }
  [[nodiscard]] const Place& place() const { return work_.mesh.at(ring_.centre); }
  /// The sum of squares around the vertex, and the most that its lines could give back.
  [[nodiscard]] float before() const { return before_; }
  [[nodiscard]] float slack() const { return slack_; }

  [[nodiscard]] bool IsInside(const Place& place) const;
  /// What the posts, and what the lines that the vertex carries, ask of its height.
  [[nodiscard]] HeightPull PullOfPosts(const Place& place) const;
  [[nodiscard]] HeightPull PullOfLines() const;
  [[nodiscard]] bool CarriesNone() const { return work_.price.LosesNone(); }
  /// The change of the sum, or any number of at least `bound` once that is certain.
  [[nodiscard]] float Cost(const Place& place, float bound) const;
  [[nodiscard]] bool IsAllowed(const Place& place) const;
  void Make(const Place& place) { work_.Put(ring_, place); }

 private:
  Workpiece& work_;
  Ring ring_;
  float before_ = 0;
  float slack_ = 0;
};

}  // namespace farhorizon
