#pragma once

#include <optional>
#include <vector>

#include "core/geometry/direction.h"

namespace farhorizon {

/// A box and a segment of the plan in plain numbers, as seen from the origin.
struct PlanBox {
  double center_x;
  double center_y;
  double half_width;
  double half_height;
};
struct PlanStroke {
  double from_x;
  double from_y;
  double to_x;
  double to_y;
};

/// A growing set of directions of sight: closed arcs, kept apart and in order. Exact.
template <typename Int>
class BasicDirectionSet {
 public:
  using Direction = BasicDirection<Int>;

  /// Adds the closed arc that turns counter-clockwise from `from` to `to` (less than half a turn;
  /// the two may be one direction). `crosses_start`: the arc passes the half turn's end and goes on
  /// at its beginning.
  void Add(const Direction& from, const Direction& to, bool crosses_start, PredicateCounts* counts);

  [[nodiscard]] bool IsComplete() const { return complete_; }

  /// True only if the directions to all points of a box, or of a segment, are in the set. For pruning:
  /// coordinates, counted from the eye, of up to 10^5 that are 10^-8 off do no harm.
  [[nodiscard]] bool SurelyContains(const PlanBox& box) const;
  [[nodiscard]] bool SurelyContains(const PlanStroke& stroke) const;

  /// The widest open range of directions that is not in the set, as vectors a positive turn of at
  /// most half a turn apart; nullopt where the set is complete.
  struct Gap {
    BasicVector<Int> from;
    BasicVector<Int> to;
  };
  [[nodiscard]] std::optional<Gap> WidestGap() const;

 private:
  struct Interval {
    Direction from;
    Direction to;
  };
  /// A vector of about unit size in plain numbers.
  struct Ray {
    double x;
    double y;
  };
  /// An open range of directions that is not in the set.
  struct Opening {
    Ray from;
    Ray to;
  };
  void AddInterval(const Direction& from, const Direction& to, PredicateCounts* counts);
  void FindOpenings();
  static Ray RayOf(const Direction& direction);

  std::vector<Interval> intervals_;
  std::vector<Opening> openings_;  ///< once there are intervals
  bool complete_ = false;
};
using DirectionSet = BasicDirectionSet<Int128>;

}  // namespace farhorizon
