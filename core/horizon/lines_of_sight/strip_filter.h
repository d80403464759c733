#pragma once

#include <array>

#include "core/horizon/lines_of_sight/strip_cell.h"
#include "core/horizon/visibility/target_segment.h"

namespace farhorizon {

/// Bounds on cells and on what hides them, in plain floating point, never smaller than the truth: what
/// lies beside each other by them does so exactly. Directions are given as slopes, minus the cotangent of
/// their angle from the edge, which rises with the angle from -infinity to infinity.
class StripFilter {
 public:
  explicit StripFilter(const TargetSegment& edge);

  struct Cell {
    double from_slope;
    double to_slope;
    double from_t;
    double to_t;
  };
  [[nodiscard]] Cell Of(const StripCell& cell) const;

  /// From the edge's lower end, in the grid's axes and in the edge's times its length.
  struct Corner {
    double x;
    double y;
    double along;
    double across;
  };
  [[nodiscard]] Corner CornerAt(std::int32_t x, std::int32_t y) const;

  /// What ground can hide at most: slopes in [from, to], or outside it where `outer`.
  struct Shade {
    double from;
    double to;
    bool outer = false;

    [[nodiscard]] bool Meets(const Cell& cell) const {
      return outer ? cell.from_slope < from || cell.to_slope > to
                   : cell.from_slope < to && cell.to_slope > from;
    }
  };
  /// What points of the convex hull of the corners can hide from any point of the edge.
  /// N: 2 or 4, instantiated in the source.
  template <std::size_t N>
  [[nodiscard]] Shade ShadeOf(const std::array<Corner, N>& corners) const;

  /// Whether what is at the corners lies beside a cell from one t to another: before `first` or past
  /// `last`, what is left of the edge's line and what is right of it each by itself.
  template <std::size_t N>
  [[nodiscard]] bool IsBeside(const std::array<Corner, N>& corners, const StripCell& cell,
                              double from, double to) const;

  /// The t up to which the edge may be lower than `top`, not above 1. Requires: top above its lower end.
  [[nodiscard]] double Reach(double top) const;

 private:
  struct SlopeRange {
    double from;
    double to;
  };
  [[nodiscard]] SlopeRange SlopesOf(const BoundaryCurve& curve, double t) const;

  TargetSegment edge_;
  double run_x_;
  double run_y_;
  double length_squared_;
};

}  // namespace farhorizon
