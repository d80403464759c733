#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/convex_polygon.h"
#include "core/horizon/sweep/hull_index.h"

namespace farhorizon {

/// One change of the hulls while the plane falls: a hull starts at a post, is extended by a post,
/// or absorbs another hull.
struct HullChange {
  enum class Kind { kStart, kExtension, kMerge };
  Kind kind = Kind::kStart;
  std::int32_t hull = 0;   ///< its slot; kStart: the slot after the last
  std::int32_t other = 0;  ///< kMerge: the slot of the absorbed hull; the last hull moves to it
  Point2i post;            ///< kStart, kExtension
};

/// The hulls of a scene in little memory: the corners of each, by slots.
struct HullSnapshot {
  std::vector<Point2i> corners;
  std::vector<std::uint32_t> ends;  ///< of each hull's corners

  [[nodiscard]] std::size_t bytes() const {
    return corners.size() * sizeof(Point2i) + ends.size() * sizeof(std::uint32_t);
  }
};

/// The merged hulls of the ground at or above one height, which are disjoint: a state of the sweep.
/// The same changes lead to the same state, slots included.
class HullScene {
 public:
  /// No hulls, over a DEM of columns x rows posts.
  HullScene(std::int32_t columns, std::int32_t rows) : index_(columns, rows) {}
  /// The hulls of a snapshot, in the same slots.
  HullScene(std::int32_t columns, std::int32_t rows, const HullSnapshot& snapshot);

  [[nodiscard]] const std::vector<ConvexPolygon>& hulls() const { return hulls_; }
  [[nodiscard]] const ConvexPolygon& hull(std::int32_t slot) const {
    return hulls_[static_cast<std::size_t>(slot)];
  }

  [[nodiscard]] const HullIndex& index() const { return index_; }

  [[nodiscard]] HullSnapshot Snapshot() const;

  /// Cost: O(c) for an extension, O(c log c) for a merge, for hulls of c corners.
  void Apply(const HullChange& change);

 private:
  std::vector<ConvexPolygon> hulls_;
  HullIndex index_;
};

}  // namespace farhorizon
