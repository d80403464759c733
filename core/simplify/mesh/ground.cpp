#include "core/simplify/mesh/ground.h"

#include "core/terrain/height_range.h"

namespace farhorizon {

Ground::Ground(const Terrain& terrain, const EarthDrop& drop)
    : terrain_(&terrain), columns_(terrain.dem().columns), rows_(terrain.dem().rows), drop_(drop) {
  const Dem& dem = terrain.dem();
  const HeightRange range = HeightRangeOf(dem);
  base_m_ = dem.height_offset_m + (0.5 * range.least + 0.5 * range.greatest) * dem.quantum_m;
  frame_.reserve(dem.heights.size());
  for (std::int32_t y = 0; y < rows_; ++y) {
    for (std::int32_t x = 0; x < columns_; ++x) {
      frame_.push_back(HasData(x, y) ? At(x, y).frame : Continued(x, y));
    }
  }
}

// The cell right of and below the post has one triangle, of its other three corners: its plane goes
// on to the post, so that both of the cell's facets, whose centroids are on that triangle's long
// edge, have its gradient. No triangle has centroids of other facets at the post.
float Ground::Continued(std::int32_t x, std::int32_t y) const {
  if (x + 1 == columns_ || y + 1 == rows_) return 0;
  if (!HasData(x + 1, y) || !HasData(x, y + 1) || !HasData(x + 1, y + 1)) return 0;
  return At(x + 1, y).frame + At(x, y + 1).frame - At(x + 1, y + 1).frame;
}

float Ground::DropAt(std::int32_t x, std::int32_t y) const {
  const double dx = x - 0.5 * (columns_ - 1);
  const double dy = y - 0.5 * (rows_ - 1);
  return static_cast<float>(drop_.column_m * dx * dx + drop_.row_m * dy * dy);
}

Place Ground::At(std::int32_t x, std::int32_t y) const {
  return WithHeight(x, y, HeightOverPlan(y * columns_ + x));
}

Place Ground::WithHeight(std::int32_t x, std::int32_t y, float plan) const {
  return {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), plan, plan - DropAt(x, y)};
}

}  // namespace farhorizon
