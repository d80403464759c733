#pragma once

#include <vector>

#include "core/terrain/mesh.h"

namespace farhorizon {

/// An edge of a decoded artifact, in the frame of the grid.
struct GridSegment {
  GridPoint a;
  GridPoint b;
};

/// Root mean square, over plan lines, of the difference between the greatest heights of two sets of
/// segments; metres.
///
/// The lines are a regular sample that is uniform in the measure of lines, direction times distance
/// [Crofton1868], over a grid of columns x rows posts, in the plan where a column is as wide as a
/// row: 192 directions, two lines a cell. Lines that miss either set do not count. The lines are
/// the same at every call. Cost: the lines that each segment crosses, in each direction.
double RmsOverLines(const std::vector<GridSegment>& first, const std::vector<GridSegment>& second,
                    std::int32_t columns, std::int32_t rows);

}  // namespace farhorizon
