#pragma once

#include <vector>

#include "core/terrain/mesh.h"

namespace farhorizon {

/// A straight piece of ground, as it is got back from a decoded artifact.
struct GridSegment {
  GridPoint a;
  GridPoint b;
};

/// Root mean square of the difference between the greatest heights of two sets of segments over plan
/// lines, metres: lines drawn uniformly in (theta, b) over a grid of columns x rows posts, in the
/// plan where a column is as wide as a row. Lines that miss either set are left out.
///
/// Deterministic: the same lines at every call. Cost: 192 directions, each the lines that segments
/// cross, two lines a cell.
double RmsOverLines(const std::vector<GridSegment>& first, const std::vector<GridSegment>& second,
                    std::int32_t columns, std::int32_t rows);

}  // namespace farhorizon
