#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/horizon/kinetic/hulls/plan_box.h"
#include "core/horizon/kinetic/hulls/sweep_depth.h"
#include "core/horizon/kinetic/neighbours/line_pencil.h"

namespace farhorizon::kinetic {

/// Where the lines of a pencil are to be found free, or to be occluded.
struct FreeLineQuery {
  std::span<const ClusterId> hulls;  ///< that may occlude lines
  ClusterId own = -1;                ///< none of them: the hull of the apex
  double x = 0;                      ///< of the apex
  double y = 0;
  bool is_placed = true;  ///< whether x and y are within PlanBox::kMargin / 2
};

/// Whether lines of the pencil that have an interior are occluded by none of the hulls. Adds hulls
/// to the pencil until they cover it, or leave a line free that misses the octagons of all others:
/// the one first that seems to be widest, of those whose octagons the line meets.
///
/// box: the octagon of a hull. Counts the hulls looked at in `looks`.
template <typename Hulls, typename BoxOf>
bool FindFreeLine(LinePencil<Hulls>& pencil, const FreeLineQuery& query, const BoxOf& box,
                  std::int64_t& looks) {
  while (const auto gap = pencil.FindGap()) {
    std::optional<Aim> direction = pencil.DirectionIn(*gap);
    if (!query.is_placed) direction.reset();
    looks += static_cast<std::int64_t>(query.hulls.size());
    const auto may_occlude = [&](ClusterId c) {
      return c != query.own &&
             !(direction && box(c).IsMissedBy(query.x, query.y, direction->x, direction->y)) &&
             !pencil.Has(c);
    };
    std::optional<ClusterId> widest;
    double width = 0;
    for (const ClusterId c : query.hulls) {
      if (!may_occlude(c)) continue;
      const double of_c = box(c).WidthFrom(query.x, query.y);
      if (widest && of_c <= width) continue;
      widest = c;
      width = of_c;
    }
    if (!widest) return true;
    pencil.Add(*widest);
    if (direction && pencil.LastOccludes(*direction)) continue;
    for (const ClusterId c : query.hulls) {
      if (!may_occlude(c)) continue;
      pencil.Add(c);
      if (direction && pencil.LastOccludes(*direction)) break;
    }
  }
  return false;
}

}  // namespace farhorizon::kinetic
