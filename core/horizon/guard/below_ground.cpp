// The segment is taken apart where it crosses grid lines: cell by cell, or from post to post where
// it runs along edges of the grid. A piece is below the ground if it is so at every terrain edge of
// the cell that it crosses, as both are straight between; exactly, in 128-bit integers. Otherwise
// it is occluded if the whole cell is inside one merged hull at a height that the piece does not
// exceed.
// Cost: constant for each cell crossed.
#include "core/horizon/guard/below_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "core/exact/int128.h"
#include "core/geometry/floor_divide.h"
#include "core/geometry/plan.h"

namespace farhorizon {

namespace {

class Walk {
 public:
  Walk(const Terrain& terrain, const HullMergeTree& hulls, const FinerHeights& scale,
       const Segment& scaled)
      : terrain_(terrain), hulls_(hulls), scale_(scale), p_(scaled.a), q_(scaled.b) {
    if (p_.x > q_.x) std::swap(p_, q_);
  }

  [[nodiscard]] bool IsBelow() const {
    const std::int32_t dx = q_.x - p_.x;
    const std::int32_t dy = q_.y - p_.y;
    // Along edges of the grid the segment passes from post to post and crosses no cell.
    if (dx == 0 || dy == 0 || dx == dy) return IsBelowFromPostToPost(std::gcd(dx, dy));
    for (std::int32_t c = p_.x; c < q_.x; ++c) {
      // The rows that the segment passes between columns c and c + 1: floor and ceiling of
      // quotients.
      const std::int64_t at_left = std::int64_t{dy} * (c - p_.x);
      const std::int64_t at_right = at_left + dy;
      const std::int64_t top = std::min(at_left, at_right);
      const std::int64_t bottom = std::max(at_left, at_right);
      const auto first = static_cast<std::int32_t>(p_.y + FloorDivide<std::int64_t>(top, dx));
      const auto last =
          static_cast<std::int32_t>(p_.y - FloorDivide<std::int64_t>(-bottom, dx)) - 1;
      for (std::int32_t r = first; r <= last; ++r) {
        if (!IsBelowInCell(c, r)) return false;
      }
    }
    return true;
  }

 private:
  [[nodiscard]] VertexId PostAt(std::int32_t column, std::int32_t row) const {
    return row * terrain_.dem().columns + column;
  }

  // A height in whole quanta that the segment does not exceed at the share t of its length.
  [[nodiscard]] std::int32_t HeightAt(double t) const {
    const double z = p_.z + t * (static_cast<double>(q_.z) - p_.z);
    // Doubles are right to 2^-20 here; a whole step up is more than that.
    return scale_.zero +
           static_cast<std::int32_t>(std::ceil((z + 1) / std::ldexp(1.0, scale_.bits)));
  }

  [[nodiscard]] bool IsBelowFromPostToPost(std::int32_t n) const {
    const std::int32_t step_x = (q_.x - p_.x) / n;
    const std::int32_t step_y = (q_.y - p_.y) / n;
    const auto is_below_post = [&](std::int32_t i) {
      const VertexId v = PostAt(p_.x + i * step_x, p_.y + i * step_y);
      if (!terrain_.dem().HasData(v)) return false;
      const std::int64_t z = scale_.Scale(terrain_.Point(v)).z;
      return (z - p_.z) * n >= (std::int64_t{q_.z} - p_.z) * i;
    };
    for (std::int32_t i = 0; i < n; ++i) {
      if (is_below_post(i) && is_below_post(i + 1)) continue;
      const std::int32_t height =
          std::max(HeightAt(static_cast<double>(i) / n), HeightAt(static_cast<double>(i + 1) / n));
      const VertexId u = PostAt(p_.x + i * step_x, p_.y + i * step_y);
      const VertexId w = PostAt(p_.x + (i + 1) * step_x, p_.y + (i + 1) * step_y);
      if (!hulls_.Occludes(u, w, height)) return false;
    }
    return true;
  }

  [[nodiscard]] bool IsBelowInCell(std::int32_t c, std::int32_t r) const {
    const VertexId nw = PostAt(c, r);
    const VertexId ne = nw + 1;
    const VertexId sw = nw + terrain_.dem().columns;
    const VertexId se = sw + 1;
    for (const VertexId v : {nw, ne, sw, se}) {
      if (!terrain_.dem().HasData(v)) return false;
    }
    const bool below_edges = IsBelowEdge(nw, ne) && IsBelowEdge(sw, se) && IsBelowEdge(nw, sw) &&
                             IsBelowEdge(ne, se) && IsBelowEdge(nw, se);
    return below_edges || IsBelowHull(c, r, {nw, ne, sw, se});
  }

  // Whether the segment is at or below the terrain edge u, w where they cross; true if they do not.
  [[nodiscard]] bool IsBelowEdge(VertexId u, VertexId w) const {
    const Point3i at_u = scale_.Scale(terrain_.Point(u));
    const Point3i at_w = scale_.Scale(terrain_.Point(w));
    std::int64_t of_w = TwiceArea(p_, q_, at_u);
    std::int64_t of_u = -TwiceArea(p_, q_, at_w);
    if ((of_u > 0 && of_w < 0) || (of_u < 0 && of_w > 0)) return true;  // no crossing
    of_u = std::abs(of_u);
    of_w = std::abs(of_w);
    const std::int64_t of_q = std::abs(TwiceArea(at_u, at_w, p_));
    const std::int64_t of_p = std::abs(TwiceArea(at_u, at_w, q_));
    const Int128 ground = Int128{of_u} * at_u.z + Int128{of_w} * at_w.z;
    const Int128 target = Int128{of_p} * p_.z + Int128{of_q} * q_.z;
    return ground * (of_p + of_q) >= target * (of_u + of_w);
  }

  // Whether the cell is inside one merged hull at a height that the segment does not exceed in it.
  [[nodiscard]] bool IsBelowHull(std::int32_t c, std::int32_t r,
                                 const std::array<VertexId, 4>& corners) const {
    const double dx = q_.x - p_.x;
    const double dy = q_.y - p_.y;
    const double by_row_from = (r + (dy < 0 ? 1 : 0) - p_.y) / dy;
    const double by_row_to = (r + (dy < 0 ? 0 : 1) - p_.y) / dy;
    const double from = std::max((c - p_.x) / dx, by_row_from);
    const double to = std::min((c + 1 - p_.x) / dx, by_row_to);
    const std::int32_t height = std::max(HeightAt(from), HeightAt(to));
    return hulls_.Occludes(corners[0], corners[1], height) &&
           hulls_.Occludes(corners[0], corners[2], height) &&
           hulls_.Occludes(corners[0], corners[3], height);
  }

  const Terrain& terrain_;
  const HullMergeTree& hulls_;
  const FinerHeights& scale_;
  Point3i p_;
  Point3i q_;
};

}  // namespace

bool GroundCovers(const Terrain& terrain, const HullMergeTree& hulls, const FinerHeights& scale,
                  const Segment& scaled) {
  return Walk(terrain, hulls, scale, scaled).IsBelow();
}

}  // namespace farhorizon
