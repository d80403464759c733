#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/exact/int128.h"
#include "core/terrain/height_range.h"
#include "core/terrain/terrain.h"
#include "tests/support/line_equation.h"

namespace farhorizon {

/// All edges of a mesh as segments, heights in whole steps of `scale`; nullopt where a height is
/// not a whole number of steps.
inline std::optional<std::vector<Segment>> ExactEdges(const Dem& dem, const FinerHeights& scale,
                                                      const PostMesh& mesh) {
  std::vector<Point3i> points(dem.heights.size());
  for (std::size_t i = 0; i < mesh.posts.size(); ++i) {
    const double quanta = (mesh.heights_m[i] - dem.height_offset_m) / dem.quantum_m;
    const double steps = std::ldexp(quanta - scale.zero, scale.bits);
    // What doubles lose of a height in metres.
    const double rounding = 1e-3 + 1e-14 * std::ldexp(std::abs(quanta) + 1e6, scale.bits);
    if (std::abs(steps - std::round(steps)) > rounding) return std::nullopt;
    const VertexId v = mesh.posts[i];
    points[static_cast<std::size_t>(v)] = {dem.Column(v), dem.Row(v),
                                           static_cast<std::int32_t>(std::round(steps))};
  }
  std::vector<Segment> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.push_back({points[static_cast<std::size_t>(t[k])],
                       points[static_cast<std::size_t>(t[(k + 1) % 3])]});
    }
  }
  return edges;
}

/// The terrain's own edges in the same steps.
inline std::vector<Segment> ExactEdges(const Terrain& terrain, const FinerHeights& scale) {
  std::vector<Segment> edges;
  for (const Edge& edge : terrain.Edges()) {
    edges.push_back({scale.Scale(terrain.Point(edge.a)), scale.Scale(terrain.Point(edge.b))});
  }
  return edges;
}

/// The definition of H: the greatest height of any edge over the line; nullopt where it misses all.
inline std::optional<Ratio<Int128>> GreatestOver(const LineEquation<Int128>& line,
                                                 const std::vector<Segment>& edges) {
  std::optional<Ratio<Int128>> greatest;
  for (const Segment& edge : edges) {
    const std::optional<Ratio<Int128>> height = HeightOver(line, edge);
    if (height && (!greatest || *greatest < *height)) greatest = height;
  }
  return greatest;
}

/// A plan line with small whole numbers: through two random ends of `edges`, or through one, or
/// none, and a random point between posts.
inline LineEquation<Int128> AnyLine(const std::vector<Segment>& edges, const Dem& dem,
                                    std::mt19937& random) {
  constexpr std::uint32_t kParts = 6;  // of a cell
  struct Point {
    std::int64_t x;
    std::int64_t y;
  };
  const auto any = [&](bool post) -> Point {
    if (post) {
      const Point3i p = edges[random() % edges.size()].a;
      return {std::int64_t{kParts} * p.x, std::int64_t{kParts} * p.y};
    }
    return {static_cast<std::int64_t>(random() % (kParts * static_cast<unsigned>(dem.columns))),
            static_cast<std::int64_t>(random() % (kParts * static_cast<unsigned>(dem.rows)))};
  };
  for (;;) {
    const std::uint32_t kind = random() % 4;
    const Point p = any(kind < 3);
    const Point q = any(kind < 2);
    const std::int64_t a = q.y - p.y;
    const std::int64_t b = p.x - q.x;
    if (a == 0 && b == 0) continue;
    // In cells: kParts times both sides.
    return {Int128{a * kParts}, Int128{b * kParts}, Int128{a * p.x + b * p.y}};
  }
}

}  // namespace farhorizon
