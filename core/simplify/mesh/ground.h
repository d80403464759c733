#pragma once

#include <cstdint>
#include <vector>

#include "core/simplify/mesh/place.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The Earth's drop below the tile's tangent plane: column_m dc^2 + row_m dr^2 metres at dc columns
/// and dr rows from the tile's middle. An edge of a mesh is straight in that frame and so sags
/// below the curved ground. 0, 0: a flat Earth.
struct EarthDrop {
  double column_m = 0;
  double row_m = 0;
};

/// The heights that the simplifier compares with: of each post, in the tile's frame, as floats
/// above the middle of the DEM's heights, so that they keep what digits there are.
class Ground {
 public:
  /// Requires: `terrain` outlives it. Memory: 4 bytes a post.
  Ground(const Terrain& terrain, const EarthDrop& drop);

  [[nodiscard]] std::int32_t columns() const { return columns_; }
  [[nodiscard]] std::int32_t rows() const { return rows_; }
  [[nodiscard]] double base_m() const { return base_m_; }
  [[nodiscard]] bool HasData(std::int32_t x, std::int32_t y) const {
    return terrain_->dem().HasData(y * columns_ + x);
  }

  /// Heights in the tile's frame of row y's posts. At a post without data: one that goes on as the
  /// triangle right of it and below does, for differences across the ground's outline.
  [[nodiscard]] const float* Row(std::int32_t y) const {
    return frame_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_);
  }
  /// Post (x, y) at its own height.
  [[nodiscard]] Place At(std::int32_t x, std::int32_t y) const;
  [[nodiscard]] Place At(VertexId v) const { return At(v % columns_, v / columns_); }
  /// Post (x, y) at another height over the plan.
  [[nodiscard]] Place WithHeight(std::int32_t x, std::int32_t y, float plan) const;
  [[nodiscard]] float HeightOverPlan(VertexId v) const {
    return static_cast<float>(terrain_->dem().HeightM(v) - base_m_);
  }
  [[nodiscard]] VertexId PostAt(const Place& place) const { return place.y * columns_ + place.x; }
  /// Whether the place is at its post's own height.
  [[nodiscard]] bool IsOwn(const Place& place) const {
    return place.plan == HeightOverPlan(PostAt(place));
  }
  [[nodiscard]] bool OnSide(const Place& p) const {
    return p.x == 0 || p.y == 0 || p.x == columns_ - 1 || p.y == rows_ - 1;
  }
  [[nodiscard]] const Terrain& terrain() const { return *terrain_; }

 private:
  [[nodiscard]] float Continued(std::int32_t x, std::int32_t y) const;
  [[nodiscard]] float DropAt(std::int32_t x, std::int32_t y) const;

  const Terrain* terrain_;
  std::int32_t columns_;
  std::int32_t rows_;
  double base_m_ = 0;
  EarthDrop drop_;
  std::vector<float> frame_;
};

}  // namespace farhorizon
