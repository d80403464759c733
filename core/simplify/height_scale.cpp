#include "core/simplify/height_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace farhorizon {
namespace {

constexpr std::int64_t kSkylineLimit = std::int64_t{1} << 30;  // |z| of a OccluderSet's segments
constexpr int kFinestShift = 10;                               // a thousandth of a quantum will do

}  // namespace

HeightScale HeightScale::For(const Terrain& terrain) {
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  std::int64_t greatest = std::numeric_limits<std::int64_t>::min();
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (!terrain.dem().HasData(v)) continue;
    least = std::min<std::int64_t>(least, terrain.Point(v).z);
    greatest = std::max<std::int64_t>(greatest, terrain.Point(v).z);
  }
  HeightScale scale;
  scale.middle = static_cast<std::int32_t>(least + (greatest - least) / 2);
  // Lowering by more than the relief hides everything, so nothing is ever lowered further than that.
  const std::int64_t reach = (greatest - least) * 2 + 2;
  while (scale.shift < kFinestShift && reach << (scale.shift + 1) < kSkylineLimit) ++scale.shift;
  const std::int64_t half = ((greatest - least) / 2 + 1) << scale.shift;
  scale.most_steps = static_cast<std::int32_t>(std::max<std::int64_t>(kSkylineLimit - 1 - half, 0));
  return scale;
}

std::int32_t HeightScale::Steps(double quanta) const {
  const double steps = std::floor(quanta * static_cast<double>(std::int64_t{1} << shift));
  return static_cast<std::int32_t>(std::clamp(steps, 0.0, static_cast<double>(most_steps)));
}

}  // namespace farhorizon
