#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// What is wrong with `mesh` as a cover of `terrain`'s domain; empty where nothing is: triangles
/// turn counter-clockwise, each directed side stands once, and areas add up to the terrain's, to
/// the unit.
inline std::string FaultOfCover(const Terrain& terrain, const std::vector<Triangle>& mesh) {
  const auto twice_area = [&terrain](const Triangle& t) {
    const Point3i a = terrain.Point(t[0]);
    const Point3i b = terrain.Point(t[1]);
    const Point3i c = terrain.Point(t[2]);
    // In the plan (column, -row).
    return std::int64_t{b.x - a.x} * (a.y - c.y) - std::int64_t{c.x - a.x} * (a.y - b.y);
  };
  std::int64_t wanted = 0;
  for (const Triangle& t : terrain.Triangles()) wanted += twice_area(t);
  std::int64_t found = 0;
  std::set<std::pair<VertexId, VertexId>> sides;
  for (const Triangle& t : mesh) {
    if (twice_area(t) <= 0) return "a triangle at post " + std::to_string(t[0]) + " is flipped";
    found += twice_area(t);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!sides.insert({t[k], t[(k + 1) % 3]}).second) return "a side stands twice";
    }
  }
  return found == wanted ? "" : "the areas differ";
}

/// Sides of `mesh` with a triangle on one side only, each as (smaller, greater).
inline std::set<Edge> OutlineOf(const std::vector<Triangle>& mesh) {
  std::map<Edge, int> count;
  for (const Triangle& t : mesh) {
    for (std::size_t k = 0; k < 3; ++k) ++count[MakeEdge(t[k], t[(k + 1) % 3])];
  }
  std::set<Edge> outline;
  for (const auto& [edge, n] : count) {
    if (n == 1) outline.insert(edge);
  }
  return outline;
}

/// The slow twin of every error measure: each post looked for in every triangle; quanta. Infinite
/// where a post of the terrain is under no triangle.
inline double GreatestVerticalError(const Terrain& terrain, const std::vector<Triangle>& mesh) {
  double greatest = 0;
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (!terrain.IsVertex(v)) continue;
    const Point3i p = terrain.Point(v);
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : mesh) {
      const Point3i a = terrain.Point(t[0]);
      const Point3i b = terrain.Point(t[1]);
      const Point3i c = terrain.Point(t[2]);
      const auto turn = [](Point3i o, Point3i q, Point3i r) {
        return std::int64_t{q.x - o.x} * (o.y - r.y) - std::int64_t{r.x - o.x} * (o.y - q.y);
      };
      const std::int64_t of_a = turn(b, c, p);
      const std::int64_t of_b = turn(c, a, p);
      const std::int64_t of_c = turn(a, b, p);
      if (of_a < 0 || of_b < 0 || of_c < 0) continue;
      const std::int64_t off = of_a * (a.z - p.z) + of_b * (b.z - p.z) + of_c * (c.z - p.z);
      least = std::min(
          least, std::abs(static_cast<double>(off)) / static_cast<double>(of_a + of_b + of_c));
    }
    greatest = std::max(greatest, least);
  }
  return greatest;
}

}  // namespace farhorizon
