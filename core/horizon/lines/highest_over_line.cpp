#include "core/horizon/lines/highest_over_line.h"

#include <algorithm>

namespace farhorizon {

namespace {

// Twice the cross product of the vector from the line to p with its direction, up to sign: 0 on the
// line.
std::int64_t Side(Point3i p, const PlanLine& line) {
  return (2 * std::int64_t{p.x} - line.x) * line.dr - (2 * std::int64_t{p.y} - line.y) * line.dc;
}

void Raise(std::optional<ExactHeight>& highest, const std::optional<ExactHeight>& height) {
  if (height && (!highest || Compare(*height, *highest) > 0)) highest = height;
}

}  // namespace

std::optional<ExactHeight> HeightOver(const Segment& segment, const PlanLine& line) {
  const std::int64_t a = Side(segment.a, line);
  const std::int64_t b = Side(segment.b, line);
  if ((a > 0 && b > 0) || (a < 0 && b < 0)) return std::nullopt;
  if (a == b) return ExactHeight{std::max(segment.a.z, segment.b.z), 1};
  // At the share a / (a - b) of the way from a to b.
  const Int128 whole = a > b ? Int128{a} - b : Int128{b} - a;
  const Int128 part = a > b ? Int128{a} : -Int128{a};
  return ExactHeight{segment.a.z * whole + part * (Int128{segment.b.z} - segment.a.z), whole};
}

std::optional<ExactHeight> HighestOver(std::span<const Segment> segments, const PlanLine& line) {
  std::optional<ExactHeight> highest;
  for (const Segment& segment : segments) Raise(highest, HeightOver(segment, line));
  return highest;
}

std::optional<ExactHeight> HighestOver(const Terrain& terrain, const PlanLine& line) {
  std::optional<ExactHeight> highest;
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    const Point3i p = terrain.Point(v);
    // Edges are at most a diagonal long: none from a post farther away reaches the line.
    const std::int64_t side = Side(p, line);
    const std::int64_t reach =
        2 * (std::abs(std::int64_t{line.dc}) + std::abs(std::int64_t{line.dr}));
    if (side > reach || side < -reach || !terrain.dem().HasData(v)) continue;
    for (const VertexId n : terrain.NeighboursOf(v)) {
      if (n > v) Raise(highest, HeightOver({p, terrain.Point(n)}, line));
    }
  }
  return highest;
}

}  // namespace farhorizon
