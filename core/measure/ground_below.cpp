#include "core/measure/ground_below.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace farhorizon {

std::optional<GroundPiece> GroundBelow(const Dem& dem, const GridPoint& p, const GridPoint& q,
                                       bool extend) {
  const double x = (p.column + q.column) / 2;
  const double y = (p.row + q.row) / 2;
  if (!(x >= 0) || !(y >= 0) || x > dem.columns - 1 || y > dem.rows - 1) return std::nullopt;
  const auto column = std::min(static_cast<std::int32_t>(x), dem.columns - 2);
  const auto row = std::min(static_cast<std::int32_t>(y), dem.rows - 2);
  const VertexId nw = row * dem.columns + column;
  std::array<std::int64_t, 4> z = {dem.heights[static_cast<std::size_t>(nw)],
                                   dem.heights[static_cast<std::size_t>(nw) + 1],
                                   dem.heights[static_cast<std::size_t>(nw + dem.columns)],
                                   dem.heights[static_cast<std::size_t>(nw + dem.columns) + 1]};
  const auto missing = std::count(z.begin(), z.end(), std::int64_t{kNoHeight});
  if (missing > (extend ? 1 : 0)) return std::nullopt;
  for (std::size_t k = 0; k < 4; ++k) {
    // Of corners 0 to 3, by rows, 3 - k is opposite to k.
    if (z[k] == kNoHeight) z[k] = z[k ^ 1U] + z[k ^ 2U] - z[3 - k];
  }
  const bool upper = x - column > y - row;
  const double by_column =
      upper ? static_cast<double>(z[1] - z[0]) : static_cast<double>(z[3] - z[2]);
  const double by_row = upper ? static_cast<double>(z[3] - z[1]) : static_cast<double>(z[2] - z[0]);
  const auto height = [&](const GridPoint& g) {
    return dem.height_offset_m +
           (static_cast<double>(z[0]) + by_column * (g.column - column) + by_row * (g.row - row)) *
               dem.quantum_m;
  };
  return GroundPiece{height(p), height(q), nw};
}

}  // namespace farhorizon
