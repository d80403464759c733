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
/// rises between them is not noticed. Memory: 28 bytes a post.
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
  // Radii 0, 1, 2, 4, ... 32: a wider ring is not ruled out.
  static constexpr std::size_t kWindows = 7;

  void Widen(std::size_t window);
  [[nodiscard]] std::size_t Index(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x);
  }

  std::int32_t columns_;
  std::int32_t rows_;
  std::array<std::vector<float>, kWindows> least_;
};

}  // namespace farhorizon
