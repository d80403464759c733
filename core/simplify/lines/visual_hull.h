#pragma once

#include <cstdint>
#include <vector>

#include "core/simplify/lines/pencils.h"
#include "core/simplify/mesh/ground.h"

namespace farhorizon {

/// The height below which an edge raises no sampled line's skyline: at each post the least H over
/// the lines of all pencils that pass beside it, and its least in windows of growing radius.
///
/// It bounds the visual hull [Laurentini94] from above, at the sampled lines only: an edge that
/// rises between them is not noticed. Memory: 10 bytes a post.
class VisualHull {
 public:
  /// skyline: H of each line; SampledSkyline::kNone where a line misses the terrain.
  VisualHull(const Ground& ground, const Pencils& pencils, const Table<float>& skyline);

  /// Whether some point of the segment, looked at every half step, is above the hull.
  [[nodiscard]] bool MayRise(const Place& a, const Place& b) const;
  /// Whether any edge among `places` and the centre may be: one look at the least height around.
  [[nodiscard]] bool MayRiseAround(const Place& centre, const Place* places,
                                   std::int32_t count) const;

 private:
  /// Heights of a grid.
  struct Grid {
    std::int32_t columns = 0;
    std::int32_t rows = 0;
    std::vector<float> height;

    [[nodiscard]] std::size_t Index(std::int32_t x, std::int32_t y) const {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(x);
    }
  };
  // The radius of beside_ is 1 post; that of wide_ 1, 2, 4 and 8 blocks of 4 x 4 posts, as the
  // wider the window, the less its place matters. A wider ring is not ruled out.
  static constexpr std::int32_t kBlock = 4;
  static constexpr std::size_t kWide = 4;

  static Grid Widened(const Grid& from, std::int32_t reach);
  static Grid InBlocks(const Grid& from);

  Grid least_;
  Grid beside_;
  std::array<Grid, kWide> wide_;
};

}  // namespace farhorizon
