// A vertex of a straight rim that no collapse can take away without a flip: its neighbours' polygon
// is cut into triangles ear by ear [Meisters75]. The polygon is simple, as it is the outline of the
// vertex's triangles with the vertex on one of its sides, so it always has an ear.
#include <algorithm>

#include "core/simplify/mesh/half_edge_mesh.h"

namespace farhorizon {

namespace {

// A corner of what is left of the polygon, and the half-edge outside its side to the next corner;
// kNone at the rim.
struct Corner {
  std::int32_t vertex;
  std::int32_t outside;
};

bool Contains(const Place& a, const Place& b, const Place& c, const Place& p) {
  return Turn(a, b, p) >= 0 && Turn(b, c, p) >= 0 && Turn(c, a, p) >= 0;
}

}  // namespace

void HalfEdgeMesh::CutOff(std::int32_t v) {
  const std::vector<std::int32_t> spokes = GatherRim(v);
  std::vector<Corner> polygon;
  std::vector<std::int32_t> free;  // triangles
  for (const std::int32_t h : spokes) {
    polygon.push_back({origin_[Next(h)], twin_[Next(h)]});
    free.push_back(h / 3);
  }
  polygon.push_back({origin_[Previous(spokes.back())], kNone});
  for (const std::int32_t t : free) origin_[3 * t] = kNone;
  out_[v] = kNone;
  degree_[v] = 0;
  triangles_ -= static_cast<std::int32_t>(free.size());
  for (const Corner& corner : polygon) ChangeDegree(corner.vertex, -1);
  ChangeDegree(polygon.front().vertex, 1);  // the rim joins the first to the last
  ChangeDegree(polygon.back().vertex, 1);

  const auto place = [&](std::size_t i) { return at_[polygon[i % polygon.size()].vertex]; };
  const auto is_ear = [&](std::size_t i) {
    const std::size_t n = polygon.size();
    const Place a = place(i + n - 1);
    const Place b = place(i);
    const Place c = place(i + 1);
    if (Turn(a, b, c) <= 0) return false;
    for (std::size_t k = 2; k + 1 < n; ++k) {
      if (Contains(a, b, c, place(i + k))) return false;
    }
    return true;
  };
  while (polygon.size() >= 3) {
    const std::size_t n = polygon.size();
    std::size_t ear = 0;
    while (ear + 1 < n && !is_ear(ear)) ++ear;
    const std::size_t before = (ear + n - 1) % n;
    const std::size_t after = (ear + 1) % n;
    const std::int32_t t = free.back();
    free.pop_back();
    origin_[3 * t] = polygon[before].vertex;
    origin_[3 * t + 1] = polygon[ear].vertex;
    origin_[3 * t + 2] = polygon[after].vertex;
    SetTwins(3 * t, polygon[before].outside);
    SetTwins(3 * t + 1, polygon[ear].outside);
    twin_[3 * t + 2] = kNone;
    ++triangles_;
    if (n > 3) {
      ChangeDegree(polygon[before].vertex, 1);
      ChangeDegree(polygon[after].vertex, 1);
      polygon[before].outside = 3 * t + 2;
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
    } else {
      SetTwins(3 * t + 2, polygon[after].outside);
      break;
    }
  }
  // All corners may have lost the half-edge that their rings began with. Only now, as a ring is
  // followed through twins.
  for (const std::int32_t h : spokes) {
    const std::int32_t t = h / 3;
    if (!Stands(t)) continue;
    Measure(t);
    for (std::int32_t k = 3 * t; k < 3 * t + 3; ++k) {
      if (!IsKnotted(origin_[k])) SetOut(origin_[k], k);
    }
  }
}

}  // namespace farhorizon
