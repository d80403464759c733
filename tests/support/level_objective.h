#pragma once

#include <algorithm>
#include <cmath>

#include "core/simplify/work/workpiece.h"
#include "tests/support/level_sums.h"

namespace farhorizon {

/// The sum that simplifying makes least, from the definitions, of any mesh on a workpiece's lines:
///   squares over posts + weight * sum over the lines that count of (H' - H)^2,
/// between `least` and `most`, as lines that graze an end of an edge may have one height or
/// another.
struct Objective {
  double least = 0;
  double most = 0;
  bool known = true;          ///< false: some line meets the mesh at a post only
  bool tops_are_true = true;  ///< what the workpiece takes for H' is H' on every line
};
inline Objective ObjectiveOf(const Workpiece& work, const HalfEdgeMesh& mesh, double slope_weight,
                             double weight) {
  Objective sum;
  const double squares = SquaresByDefinition(mesh, slope_weight);
  sum.least = squares;
  sum.most = squares;
  for (const Pencils::Pencil& pencil : work.skyline.pencils().pencils()) {
    for (std::int32_t i = 0; i < pencil.count; ++i) {
      const std::int32_t line = pencil.first + i;
      if (!work.skyline.Counts(line)) continue;
      const HeightBracket height = HeightOverByDefinition(mesh, pencil, i);
      if (std::isinf(height.least)) {
        sum.known = false;
        continue;
      }
      const double dem = work.skyline.dem()[line];
      const double low = height.least - dem;
      const double high = height.most - dem;
      sum.most += weight * std::max(low * low, high * high);
      if (low > 0 || high < 0) sum.least += weight * std::min(low * low, high * high);
      const double top = work.skyline.top(line);
      const double rounding = 1e-3 + 1e-5 * std::abs(top);
      if (top < height.least - rounding || top > height.most + rounding) sum.tops_are_true = false;
    }
  }
  return sum;
}

}  // namespace farhorizon
