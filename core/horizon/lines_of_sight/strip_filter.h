#pragma once

#include <array>

#include "core/horizon/lines_of_sight/strip_cell.h"
#include "core/horizon/visibility/target_segment.h"

namespace farhorizon {

/// Decides in floating point, where it can, that an occluder occludes nothing of a cell of one
/// edge's strip. All bounds are rounded outwards: what they say to be disjoint is so exactly.
///
/// A direction is measured by its slope, minus the cotangent of its angle from the edge's
/// direction: it rises through the half turn from -infinity to infinity.
class StripFilter {
 public:
  explicit StripFilter(const TargetSegment& edge);

  /// Where a cell lies in the strip, at most.
  struct CellBounds {
    double from_slope;
    double to_slope;
    double from_t;
    double to_t;
  };
  [[nodiscard]] CellBounds BoundsOf(const StripCell& cell) const;

  /// A corner of the convex hull of an occluder in plan, from the edge's lower end: in columns and
  /// rows, and along and across the edge, times its length. Exact.
  struct Corner {
    double x;
    double y;
    double along;
    double across;
  };
  [[nodiscard]] Corner CornerAt(std::int32_t x, std::int32_t y) const;

  /// The slopes that an occluder can occlude at most, at all t together: those in [from, to], or
  /// those outside it where `outer`.
  struct OccludedSlopes {
    double from;
    double to;
    bool outer = false;

    [[nodiscard]] bool Overlap(const CellBounds& cell) const {
      return outer ? cell.from_slope < from || cell.to_slope > to
                   : cell.from_slope < to && cell.to_slope > from;
    }
  };
  /// Of an occluder in the convex hull of the corners, of any height.
  /// N: 2 for a segment or 4 for a box, instantiated in the source.
  template <std::size_t N>
  [[nodiscard]] OccludedSlopes OccludedSlopesOf(const std::array<Corner, N>& corners) const;

  /// Whether an occluder in the convex hull of the corners occludes no direction of the cell for t
  /// in [from, to]. Sharper than OccludedSlopesOf, as both are followed with t, and dearer.
  template <std::size_t N>
  [[nodiscard]] bool SurelyDisjoint(const std::array<Corner, N>& corners, const StripCell& cell,
                                    double from, double to) const;

  /// An upper bound on the t at which the edge is lower than `top`; at most 1.
  /// Requires: `top` is above the edge's lower end.
  [[nodiscard]] double LastTBelow(double top) const;

 private:
  struct SlopeBounds {
    double from;
    double to;
  };
  [[nodiscard]] SlopeBounds SlopesOf(const BoundaryCurve& curve, double t) const;

  TargetSegment edge_;
  double run_x_;
  double run_y_;
  double length_squared_;
};

}  // namespace farhorizon
