#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/terrain/mesh.h"

namespace farhorizon {

/// The normals of plan lines whose directions fill an angle of less than half a turn, from its
/// first direction to its last, in the sense from columns to rows.
///
///        first.y  last
///           \    /          a line of direction d has the normal (-d.y, d.x)
///            \  /
///             \/
struct DirectionRange {
  struct Normal {
    double x = 0;
    double y = 0;
  };
  Normal first;
  Normal last;

  static DirectionRange Of(double first_radians, double last_radians) {
    return {{-std::sin(first_radians), std::cos(first_radians)},
            {-std::sin(last_radians), std::cos(last_radians)}};
  }
  [[nodiscard]] Normal Middle() const {
    const double x = first.x + last.x;
    const double y = first.y + last.y;
    const double length = std::sqrt(x * x + y * y);
    return {x / length, y / length};
  }
  /// The sine of the angle: its size where it is small.
  [[nodiscard]] double Width() const { return first.x * last.y - first.y * last.x; }
};

/// A box of lines: those through the points of a segment in a range of directions.
///
/// Its four corners are the lines through an end of the segment at an end of the range, in the
/// order (from, first), (from, last), (to, first), (to, last). A function of a point p that is
/// linear in it and in the normal, such as on which side of a line p is, has one sign on the box
/// if it has it at the corners: it is linear along the segment, and a sine of the direction, which
/// is over less than half a turn nowhere below 0 if it is not so at the ends.
struct LineBox {
  GridPoint from;
  GridPoint to;
  DirectionRange directions;

  static constexpr std::size_t kCorners = 4;
  /// Which side of the corner lines (column, row) is on, and how far: positive along the normal.
  [[nodiscard]] std::array<double, kCorners> Offsets(double column, double row) const {
    const double x0 = column - from.column;
    const double y0 = row - from.row;
    const double x1 = column - to.column;
    const double y1 = row - to.row;
    const DirectionRange::Normal& n = directions.first;
    const DirectionRange::Normal& m = directions.last;
    return {x0 * n.x + y0 * n.y, x0 * m.x + y0 * m.y, x1 * n.x + y1 * n.y, x1 * m.x + y1 * m.y};
  }
  /// The segment's height at a corner.
  [[nodiscard]] double HeightAt(std::size_t corner) const {
    return corner < 2 ? from.height_m : to.height_m;
  }
};

}  // namespace farhorizon
