#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/horizon/horizon.h"
#include "core/pipeline/ground_step.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Parallel lines of sight across a terrain's plan, evenly apart, towards one azimuth.
///
/// A point's offset is its distance to the right of the line through the terrain's middle, metres
/// on the ground as it is there.
struct ParallelLines {
  double azimuth_deg = 0;
  double offset_a_column = 0;  ///< how much the offset grows from column to column
  double offset_a_row = 0;
  double offset_at_origin = 0;  ///< of column 0, row 0
  double first_offset = 0;      ///< of the first line, the leftmost
  double spacing = 1;
  int count = 0;

  [[nodiscard]] double OffsetOf(double column, double row) const {
    return offset_at_origin + offset_a_column * column + offset_a_row * row;
  }
  [[nodiscard]] double OffsetOfLine(int i) const { return first_offset + spacing * i; }
};

/// Lines through the whole of a terrain's plan: the first and the last half a spacing inside.
/// step: at the terrain's middle.
ParallelLines LinesAcross(const Dem& dem, const GroundStep& step, double azimuth_deg, int count);

/// The greatest height over each line, metres; NaN where a line meets nothing. A line meets an edge
/// also at its ends. In floating point; slow twin: HighestOver (highest_over_line.h).
using SkylineProfile = std::vector<double>;

/// The terrain's own: horizon edges alone have it (core/horizon/README.md).
/// Cost: O(edges + lines that they meet).
SkylineProfile ProfileOf(const Dem& dem, const Horizon& horizon, const ParallelLines& lines);
/// A mesh's, from its own edges. Cost: likewise.
SkylineProfile ProfileOf(const GridMesh& mesh, const ParallelLines& lines);

/// "north" for 0, "south-west" for 225. Requires: a multiple of 45, 0 to 315.
std::string PointOfCompass(int azimuth_deg);

}  // namespace farhorizon
