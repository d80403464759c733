#pragma once

#include <optional>
#include <vector>

#include "core/geometry/direction.h"

namespace farhorizon {

/// A box of the plan, in doubles, relative to a point of view.
struct PlanBox {
  double center_x;
  double center_y;
  double half_width;
  double half_height;
};
/// A segment of the plan, in doubles, relative to a point of view.
struct PlanSegment {
  double from_x;
  double from_y;
  double to_x;
  double to_y;
};

/// A growing set of directions: disjoint closed arcs of the half turn, in order. Exact.
template <typename Int>
class BasicDirectionSet {
 public:
  using Direction = BasicDirection<Int>;

  /// Adds the closed arc that turns counter-clockwise from `from` to `to`, by less than half a
  /// turn; the two may be one direction.
  /// crosses_start: the arc passes the end of the half turn and goes on at its start.
  void Add(const Direction& from, const Direction& to, bool crosses_start, PredicateCounts* counts);

  /// Whether the set is the whole half turn.
  [[nodiscard]] bool IsComplete() const { return complete_; }

  /// True only if the directions to all points of the box, or of the segment, are in the set. May
  /// be false for some of which this is so. Requires: coordinates are below 2^17 and no more than
  /// 10^-8 off.
  [[nodiscard]] bool SurelyContains(const PlanBox& box) const;
  [[nodiscard]] bool SurelyContains(const PlanSegment& segment) const;

  /// An open arc of directions outside the set: from `from` counter-clockwise to `to`, by half a
  /// turn at most.
  struct FreeArc {
    BasicVector<Int> from;
    BasicVector<Int> to;
  };
  /// The widest one, by the keys of its ends; nullopt where the set is complete.
  [[nodiscard]] std::optional<FreeArc> WidestFreeArc() const;

 private:
  struct Arc {
    Direction from;
    Direction to;
  };
  /// A vector with |x| + |y| = 1, about.
  struct UnitVector {
    double x;
    double y;
  };
  /// A FreeArc in doubles.
  struct ApproximateFreeArc {
    UnitVector from;
    UnitVector to;
  };
  void AddWithinHalfTurn(const Direction& from, const Direction& to, PredicateCounts* counts);
  void UpdateFreeArcs();
  static UnitVector UnitVectorOf(const Direction& direction);

  std::vector<Arc> arcs_;
  std::vector<ApproximateFreeArc> free_arcs_;  ///< up to date once arcs_ is not empty
  bool complete_ = false;
};
using DirectionSet = BasicDirectionSet<Int128>;

}  // namespace farhorizon
