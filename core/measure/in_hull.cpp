#include "core/measure/in_hull.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace farhorizon {

bool IsInHull(const Dem& dem, const HullMergeTree& hulls, const GridPoint& a, const GridPoint& b,
              double less_m) {
  const double highest = std::max(a.height_m, b.height_m) + less_m;
  const double quanta = std::ceil((highest - dem.height_offset_m) / dem.quantum_m);
  if (!(std::abs(quanta) < 1 << 30)) return false;
  const auto height = static_cast<std::int32_t>(quanta);
  // All corners of the cells of both ends are in one hull, so the segment is.
  std::optional<VertexId> first;
  for (const GridPoint* p : {&a, &b}) {
    if (!(p->column >= 0) || !(p->row >= 0)) return false;
    if (p->column > dem.columns - 1 || p->row > dem.rows - 1) return false;
    const auto column = std::min(static_cast<std::int32_t>(p->column), dem.columns - 2);
    const auto row = std::min(static_cast<std::int32_t>(p->row), dem.rows - 2);
    const VertexId nw = row * dem.columns + column;
    if (!first) first = nw;
    for (const VertexId v : {nw + dem.columns + 1, nw, nw + 1, nw + dem.columns}) {
      if (!hulls.Occludes(*first, v, height)) return false;
    }
  }
  return true;
}

}  // namespace farhorizon
