#include "core/pipeline/compare/terrain_height.h"

#include <algorithm>
#include <utility>

namespace farhorizon {

std::optional<double> TerrainHeightAt(const Dem& dem, double column, double row) {
  if (!(column >= 0 && row >= 0 && column <= dem.columns - 1 && row <= dem.rows - 1)) {
    return std::nullopt;
  }
  const auto c = std::min(static_cast<std::int32_t>(column), dem.columns - 2);
  const auto r = std::min(static_cast<std::int32_t>(row), dem.rows - 2);
  const double x = column - c;
  const double y = row - r;
  // The diagonal runs from (c, r) to (c + 1, r + 1): the third corner is on the point's side of it.
  const VertexId first = r * dem.columns + c;
  const VertexId last = first + dem.columns + 1;
  const VertexId third = x >= y ? first + 1 : first + dem.columns;
  // A corner without weight need not be there.
  double height = 0;
  for (const auto& [v, weight] : {std::pair{first, 1 - std::max(x, y)},
                                  {third, std::max(x, y) - std::min(x, y)},
                                  {last, std::min(x, y)}}) {
    if (weight == 0) continue;
    if (!dem.HasData(v)) return std::nullopt;
    height += weight * dem.HeightM(v);
  }
  return height;
}

}  // namespace farhorizon
