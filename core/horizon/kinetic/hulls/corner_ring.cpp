#include "core/horizon/kinetic/hulls/corner_ring.h"

#include <algorithm>
#include <utility>

#include "core/base/result.h"
#include "core/horizon/kinetic/hulls/hull_location.h"

namespace farhorizon::kinetic {

std::vector<PointId> HullOf(const KineticHulls& hulls, std::vector<PointId> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Check(points.size() >= 3, "the ground just below a post has a width");
  std::sort(points.begin(), points.end(), [&](PointId a, PointId b) {
    const int order = OrderAfter(hulls.point(a).path, hulls.point(b).path, hulls.now());
    return order != 0 ? order < 0 : a < b;
  });
  std::vector<PointId> ring;
  const auto append = [&](PointId p, std::size_t least) {
    while (ring.size() > least && hulls.Orient(ring[ring.size() - 2], ring.back(), p) <= 0) {
      ring.pop_back();
    }
    ring.push_back(p);
  };
  for (const PointId p : points) append(p, 1);
  const std::size_t lower = ring.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) append(points[i], lower);
  ring.pop_back();
  Check(ring.size() >= 3, "no ground is a line");
  return ring;
}

void RemoveReflex(const KineticHulls& hulls, std::vector<PointId>& ring) {
  const auto turns_left = [&](PointId a, PointId b, PointId c) {
    return hulls.Orient(a, b, c) > 0;
  };
  std::size_t size = 0;
  for (const PointId p : ring) {
    while (size >= 2 && !turns_left(ring[size - 2], ring[size - 1], p)) --size;
    ring[size++] = p;
  }
  std::size_t first = 0;
  while (size - first >= 3) {
    if (!turns_left(ring[size - 2], ring[size - 1], ring[first])) {
      --size;
    } else if (!turns_left(ring[size - 1], ring[first], ring[first + 1])) {
      ++first;
    } else {
      break;
    }
  }
  ring.resize(size);
  ring.erase(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first));
}

bool AddOutside(const KineticHulls& hulls, PointId p, std::vector<PointId>& ring) {
  if (TriangleAround(hulls, ring, hulls.path(p))) return false;
  const std::size_t n = ring.size();
  const auto is_seen = [&](std::size_t i) {
    return hulls.Orient(ring[i % n], ring[(i + 1) % n], p) <= 0;
  };
  std::size_t first = 0;  // the first edge that is seen
  if (is_seen(0)) {
    first = n;
    while (is_seen(first - 1)) --first;
  } else {
    while (!is_seen(first)) Check(++first < n, "an edge is seen from outside");
  }
  std::size_t last = first;
  while (is_seen(last + 1)) ++last;
  std::vector<PointId> next{p};
  for (std::size_t i = last + 1; i <= first + n; ++i) next.push_back(ring[i % n]);
  ring = std::move(next);
  return true;
}

}  // namespace farhorizon::kinetic
