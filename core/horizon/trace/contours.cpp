// The border of a slice, triangle by triangle: it crosses each triangle with ground on both sides
// of the height in one segment, from one edge to another. The segments are joined at the edges they
// cross.
#include "core/horizon/trace/contours.h"

#include <map>
#include <optional>
#include <set>
#include <utility>

namespace farhorizon {

namespace {

// The segment of a contour in one triangle.
struct ContourSegment {
  Edge in;
  Edge out;
};

// Triangles turn one way, so that all segments have the slice on the same side.
std::optional<ContourSegment> SegmentIn(const Terrain& terrain, const Triangle& t,
                                        std::int32_t height) {
  const auto inside = [&](std::size_t i) { return terrain.Point(t[i % 3]).z >= height; };
  std::optional<Edge> in;
  std::optional<Edge> out;
  for (std::size_t i = 0; i < 3; ++i) {
    if (inside(i) == inside(i + 1)) continue;
    (inside(i) ? in : out) = MakeEdge(t[i], t[(i + 1) % 3]);
  }
  if (!in || !out) return std::nullopt;
  return ContourSegment{*in, *out};
}

PlanPoint CrossingOf(const Terrain& terrain, Edge edge, std::int32_t height) {
  const Point3i a = terrain.Point(edge.a);
  const Point3i b = terrain.Point(edge.b);
  const double t = (static_cast<double>(height) - a.z) / (static_cast<double>(b.z) - a.z);
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

}  // namespace

std::vector<std::vector<PlanPoint>> ContoursAt(const Terrain& terrain, std::int32_t height) {
  std::map<Edge, Edge> next;
  std::set<Edge> reached;  // edges at which some segment ends
  for (const Triangle& t : terrain.Triangles()) {
    const std::optional<ContourSegment> segment = SegmentIn(terrain, t, height);
    if (!segment) continue;
    next.emplace(segment->in, segment->out);
    reached.insert(segment->out);
  }
  std::vector<std::vector<PlanPoint>> contours;
  const auto follow = [&](Edge edge) {
    std::vector<PlanPoint>& contour = contours.emplace_back();
    contour.push_back(CrossingOf(terrain, edge, height));
    for (auto at = next.find(edge); at != next.end(); at = next.find(edge)) {
      edge = at->second;
      next.erase(at);
      contour.push_back(CrossingOf(terrain, edge, height));
    }
  };
  // Open contours first, from their beginnings; the others are closed.
  std::vector<Edge> beginnings;
  for (const auto& [in, out] : next) {
    if (!reached.contains(in)) beginnings.push_back(in);
  }
  for (const Edge edge : beginnings) follow(edge);
  while (!next.empty()) follow(next.begin()->first);
  return contours;
}

}  // namespace farhorizon
