// The border of a slice, triangle by triangle: the level enters each that it cuts over one edge and leaves
// it over another, so that the pieces are strung together by the edges they cross.
#include "core/horizon/trace/contours.h"

#include <map>
#include <optional>
#include <utility>

namespace farhorizon {
namespace {

struct Piece {
  Edge in;
  Edge out;
};

// Keeps the ground on one side, whichever way the triangles turn.
std::optional<Piece> PieceIn(const Terrain& terrain, const Triangle& t, std::int32_t level) {
  const auto inside = [&](std::size_t i) { return terrain.Point(t[i % 3]).z >= level; };
  std::optional<Edge> in;
  std::optional<Edge> out;
  for (std::size_t i = 0; i < 3; ++i) {
    if (inside(i) == inside(i + 1)) continue;
    (inside(i) ? in : out) = MakeEdge(t[i], t[(i + 1) % 3]);
  }
  if (!in || !out) return std::nullopt;
  return Piece{*in, *out};
}

PlanPoint CrossingOf(const Terrain& terrain, Edge edge, std::int32_t level) {
  const Point3i a = terrain.Point(edge.a);
  const Point3i b = terrain.Point(edge.b);
  const double t = (static_cast<double>(level) - a.z) / (static_cast<double>(b.z) - a.z);
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

}  // namespace

std::vector<std::vector<PlanPoint>> ContoursAt(const Terrain& terrain, std::int32_t level) {
  std::map<Edge, Edge> next;
  std::map<Edge, bool> entered;  // edges that some piece leaves over
  for (const Triangle& t : terrain.Triangles()) {
    const std::optional<Piece> piece = PieceIn(terrain, t, level);
    if (!piece) continue;
    next.emplace(piece->in, piece->out);
    entered.emplace(piece->out, true);
  }
  std::vector<std::vector<PlanPoint>> contours;
  const auto follow = [&](Edge edge) {
    std::vector<PlanPoint>& contour = contours.emplace_back();
    contour.push_back(CrossingOf(terrain, edge, level));
    for (auto at = next.find(edge); at != next.end(); at = next.find(edge)) {
      edge = at->second;
      next.erase(at);
      contour.push_back(CrossingOf(terrain, edge, level));
    }
  };
  // Open ones first, from their beginnings; what is left then is closed.
  std::vector<Edge> beginnings;
  for (const auto& [in, out] : next) {
    if (!entered.contains(in)) beginnings.push_back(in);
  }
  for (const Edge edge : beginnings) follow(edge);
  while (!next.empty()) follow(next.begin()->first);
  return contours;
}

}  // namespace farhorizon
