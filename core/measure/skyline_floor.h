#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/measure/line_box.h"
#include "core/measure/skyline_net.h"

namespace farhorizon {

/// How lines are sorted: by direction into `directions` equal ranges of the half turn, by offset
/// from the middle of the plan into strips one cell wide.
///
/// The lines of range k through a point are in the strips between its offsets at the two ends of
/// the range; `slack` is what an offset in between can be beyond those.
struct LineStrips {
  int directions = 0;
  std::int32_t count = 0;
  double column = 0;  ///< the middle
  double row = 0;
  double slack = 0;

  /// For the points of a box of the plan: so many ranges that lines of one that have one offset are
  /// a few cells apart at most.
  static LineStrips Of(double columns, double rows);

  [[nodiscard]] DirectionRange Range(int k) const;
  [[nodiscard]] double OffsetOf(const GridPoint& p, DirectionRange::Normal n) const {
    return (p.column - column) * n.x + (p.row - row) * n.y;
  }
  /// The strip that has an offset, in [0, count).
  [[nodiscard]] std::int32_t StripOf(double offset) const;
};

/// A bound from below of a skyline: for each range of directions and each strip, a height that the
/// greatest height of the net over any line there is not below.
///
/// heights: directions x count, metres; minus infinity where nothing is known.
/// After theorem 4 of core/horizon/README.md: connected segments at or above a height are met by
/// every line between their two outermost points.
struct SkylineFloor {
  LineStrips strips;
  std::vector<float> heights;

  /// The least in the strips [first, last] of range k.
  [[nodiscard]] double Least(int k, std::int32_t first, std::int32_t last) const;
};

/// lowered_m: how far each segment of the net is taken below its place; infinity: left out.
/// Errors: kCancelled. Cost: directions x (segments + strips).
Result<SkylineFloor> FindSkylineFloor(const SkylineNet& net, const std::vector<double>& lowered_m,
                                      const LineStrips& strips, const RunControl& control);

}  // namespace farhorizon
