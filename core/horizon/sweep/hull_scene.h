#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/convex_polygon.h"
#include "core/horizon/sweep/hull_index.h"

namespace farhorizon {

/// One step of the descending plane: a hull is born from a post, grows by a post, or joins another.
struct HullChange {
  enum class Kind { kBirth, kGrowth, kMerge };
  Kind kind = Kind::kBirth;
  std::int32_t hull = 0;   ///< its place; the new last one for a birth
  std::int32_t other = 0;  ///< kMerge: the one that is lost; the last one takes its place
  Point2i post;            ///< kBirth, kGrowth
};

/// The merged hulls of the ground at or above a level, none of which meet: a state of the sweep, which the
/// changes that led to it lead to again.
class HullScene {
 public:
  /// None yet, of a DEM of so many posts.
  HullScene(std::int32_t columns, std::int32_t rows) : index_(columns, rows) {}

  [[nodiscard]] const std::vector<ConvexPolygon>& hulls() const { return hulls_; }
  [[nodiscard]] const ConvexPolygon& hull(std::int32_t place) const {
    return hulls_[static_cast<std::size_t>(place)];
  }

  [[nodiscard]] const HullIndex& index() const { return index_; }

  /// Cost: O(c) for growth, O(c log c) for a merge, for hulls of c corners.
  void Apply(const HullChange& change);

 private:
  std::vector<ConvexPolygon> hulls_;
  HullIndex index_;
};

}  // namespace farhorizon
