#include "core/horizon/kinetic/neighbours/frozen_hulls.h"

#include "core/base/result.h"

namespace farhorizon::kinetic {

namespace {

bool AtOnePlace(const MovingPoint& a, const MovingPoint& b) {
  return Int128{a.x} * b.d == Int128{b.x} * a.d && Int128{a.y} * b.d == Int128{b.y} * a.d;
}

}  // namespace

// The corners run counter-clockwise, but some may have met or come in line. Each point is held
// against the two that stay before it, and the last ones against the first ones.
const std::vector<PointId>& FrozenHulls::corners(ClusterId c) const {
  std::vector<PointId>& ring = rings_[Index(c)];
  if (!ring.empty()) return ring;
  std::vector<MovingPoint> kept;
  const auto in_line = [&](const MovingPoint& a, const MovingPoint& b, const MovingPoint& p) {
    return AtOnePlace(a, b) || AtOnePlace(b, p) || OrientAt(a, b, p, 0) == 0;
  };
  for (const PointId p : hulls_.corners(hulls_.clusters()[Index(c)])) {
    const MovingPoint at = hulls_.path(p).At(s_);
    while (kept.size() >= 2 && in_line(kept[kept.size() - 2], kept.back(), at)) kept.pop_back();
    if (kept.empty() || !AtOnePlace(kept.back(), at)) kept.push_back(at);
  }
  std::size_t first = 0;
  while (kept.size() - first > 3) {
    if (in_line(kept[kept.size() - 2], kept.back(), kept[first])) {
      kept.pop_back();
    } else if (in_line(kept.back(), kept[first], kept[first + 1])) {
      ++first;
    } else {
      break;
    }
  }
  for (std::size_t i = first; i < kept.size(); ++i) {
    ring.push_back(static_cast<PointId>(paths_.size()));
    paths_.push_back(kept[i]);
  }
  Check(ring.size() >= 3, "a hull that was below its first depth has a width");
  return ring;
}

}  // namespace farhorizon::kinetic
