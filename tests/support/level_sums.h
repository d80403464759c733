#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/simplify/lines/pencils.h"
#include "core/simplify/mesh/half_edge_mesh.h"

namespace farhorizon {

/// Whether the rim runs straight through its vertex v.
inline bool RimIsStraight(const HalfEdgeMesh& mesh, std::int32_t v) {
  const std::vector<std::int32_t> spokes = mesh.GatherRim(v);
  return Turn(mesh.at(mesh.origin(HalfEdgeMesh::Next(spokes.front()))), mesh.at(v),
              mesh.at(mesh.origin(HalfEdgeMesh::Previous(spokes.back())))) == 0;
}

/// The triangle of the mesh that covers the plan point, by its first half-edge; kNone: none does.
/// Each triangle is looked at.
inline std::int32_t TriangleAt(const HalfEdgeMesh& mesh, double x, double y) {
  const auto turn = [&](const Place& p, const Place& q) {
    return (p.x - x) * (q.y - y) - (q.x - x) * (p.y - y);
  };
  for (std::int32_t h = 0; h < mesh.half_edges(); h += 3) {
    if (!mesh.Stands(h / 3)) continue;
    const Place& a = mesh.at(mesh.origin(h));
    const Place& b = mesh.at(mesh.origin(h + 1));
    const Place& c = mesh.at(mesh.origin(h + 2));
    if (turn(a, b) >= 0 && turn(b, c) >= 0 && turn(c, a) >= 0) return h;
  }
  return HalfEdgeMesh::kNone;
}

/// Height in the tile's frame and its change by column and by row, doubles.
struct PlaneAt {
  double height = 0;
  double by_column = 0;
  double by_row = 0;
};
inline PlaneAt PlaneOf(const HalfEdgeMesh& mesh, std::int32_t h, double x, double y) {
  const Place& a = mesh.at(mesh.origin(h));
  const Place& b = mesh.at(mesh.origin(h + 1));
  const Place& c = mesh.at(mesh.origin(h + 2));
  const auto area = static_cast<double>(Turn(a, b, c));
  const double bz = static_cast<double>(b.frame) - static_cast<double>(a.frame);
  const double cz = static_cast<double>(c.frame) - static_cast<double>(a.frame);
  PlaneAt plane;
  plane.by_column = (bz * (c.y - a.y) - cz * (b.y - a.y)) / area;
  plane.by_row = (cz * (b.x - a.x) - bz * (c.x - a.x)) / area;
  plane.height =
      static_cast<double>(a.frame) + plane.by_column * (x - a.x) + plane.by_row * (y - a.y);
  return plane;
}

/// visit(what the mesh is off) for each post of the terrain's domain.
template <typename Visit>
void ForEachErrorByDefinition(const HalfEdgeMesh& mesh, Visit visit) {
  const Ground& ground = mesh.ground();
  for (VertexId v = 0; v < mesh.vertices(); ++v) {
    if (!ground.terrain().IsVertex(v)) continue;
    const std::int32_t x = v % ground.columns();
    const std::int32_t y = v / ground.columns();
    const std::int32_t under = TriangleAt(mesh, x, y);
    visit(under == HalfEdgeMesh::kNone
              ? std::numeric_limits<double>::infinity()
              : static_cast<double>(ground.At(v).frame) - PlaneOf(mesh, under, x, y).height);
  }
}

/// What (mesh's gradient - terrain's)^2 is at the centroid of the facet of the cell at (x, y) right
/// of its diagonal, or left: on the triangle just to the right of the centroid and a little below;
/// 0 where there is none. A cell with three posts has one facet for both.
inline double SlopeByDefinition(const HalfEdgeMesh& mesh, std::int32_t x, std::int32_t y,
                                bool right) {
  constexpr double kRight = 1e-3;  // cells: small beside the slopes of edges of small meshes
  constexpr double kBelow = 1e-6;
  const double across = x + (right ? 2 : 1) / 3.0;
  const double down = y + (right ? 1 : 2) / 3.0;
  const std::int32_t under = TriangleAt(mesh, across + kRight, down + kBelow);
  if (under == HalfEdgeMesh::kNone) return 0;
  const Ground& ground = mesh.ground();
  const Terrain::CellTriangles cell = ground.terrain().Cell(x, y);
  const Triangle& facet = cell.triangles[cell.count == 2 && !right ? 1 : 0];
  const Place a = ground.At(facet[0]);
  const Place b = ground.At(facet[1]);
  const Place c = ground.At(facet[2]);
  const PlaneAt plane = PlaneOf(mesh, under, x, y);
  const auto beyond = [&](const Place& p) {
    return static_cast<double>(p.frame) - static_cast<double>(a.frame) -
           plane.by_column * (p.x - a.x) - plane.by_row * (p.y - a.y);
  };
  const auto area = static_cast<double>(Turn(a, b, c));
  return std::pow((beyond(b) * (c.y - a.y) - beyond(c) * (b.y - a.y)) / area, 2) +
         std::pow((beyond(c) * (b.x - a.x) - beyond(b) * (c.x - a.x)) / area, 2);
}

/// The sum over the posts of the domain of (f' - f)^2, and over facets' centroids of half of
/// slope_weight |grad f' - grad f|^2.
inline double SquaresByDefinition(const HalfEdgeMesh& mesh, double slope_weight) {
  double sum = 0;
  ForEachErrorByDefinition(mesh, [&](double off) { sum += off * off; });
  for (std::int32_t y = 0; y + 1 < mesh.ground().rows(); ++y) {
    for (std::int32_t x = 0; x + 1 < mesh.ground().columns(); ++x) {
      sum += slope_weight / 2 *
             (SlopeByDefinition(mesh, x, y, true) + SlopeByDefinition(mesh, x, y, false));
    }
  }
  return sum;
}
inline double GreatestErrorByDefinition(const HalfEdgeMesh& mesh) {
  double greatest = 0;
  ForEachErrorByDefinition(mesh, [&](double off) { greatest = std::max(greatest, std::abs(off)); });
  return greatest;
}

/// The same sum as the simplifier has it: over triangles and the rim.
inline double SquaresOf(const HalfEdgeMesh& mesh) {
  double sum = 0;
  for (std::int32_t h = 0; h < mesh.half_edges(); ++h) {
    if (!mesh.Stands(h / 3)) continue;
    const Place& a = mesh.at(mesh.origin(h));
    const Place& b = mesh.at(mesh.origin(HalfEdgeMesh::Next(h)));
    const Place& c = mesh.at(mesh.origin(HalfEdgeMesh::Previous(h)));
    if (h % 3 == 0) sum += static_cast<double>(mesh.measure().Of(a, b, c));
    if (mesh.twin(h) == HalfEdgeMesh::kNone) {
      sum += static_cast<double>(mesh.measure().OfRim(a, b));
    }
  }
  return sum;
}

/// A bracket of the mesh's greatest height over a line: `least` without the edges that end within
/// 1e-3 cells of the line, `most` with those that fail to meet it by less. Where an edge runs
/// nearly along the line, floats lose what they do of its ends' distances. -infinity: none.
struct HeightBracket {
  double least = -std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
};
inline HeightBracket HeightOverByDefinition(const HalfEdgeMesh& mesh, const Pencils::Pencil& pencil,
                                            std::int32_t i) {
  constexpr double kBeside = 1e-3;
  constexpr double kOfADistance = 1e-5;  // floats, small tiles
  HeightBracket found;
  const auto distance = [&](const Place& p) {
    return static_cast<double>(pencil.x) * p.x + static_cast<double>(pencil.y) * p.y -
           static_cast<double>(pencil.shift) - i;
  };
  for (std::int32_t h = 0; h < mesh.half_edges(); ++h) {
    if (!mesh.Stands(h / 3) || mesh.twin(h) > h) continue;
    const Place& a = mesh.at(mesh.origin(h));
    const Place& b = mesh.at(mesh.origin(HalfEdgeMesh::Next(h)));
    const double s = distance(a);
    const double t = distance(b);
    if (std::min(s, t) > kBeside || std::max(s, t) < -kBeside) continue;
    const double share = s == t ? 0 : std::clamp(s / (s - t), 0.0, 1.0);
    const double rise = static_cast<double>(b.plan) - static_cast<double>(a.plan);
    double height = static_cast<double>(a.plan) + share * rise;
    const double loss = kOfADistance * std::abs(rise / std::max(std::abs(s - t), kBeside));
    if (std::min(s, t) < -kBeside && std::max(s, t) > kBeside) {
      found.least = std::max(found.least, height - loss);
      height += loss;
    }
    if (std::abs(s) < kBeside) height = std::max(height, static_cast<double>(a.plan));
    if (std::abs(t) < kBeside) height = std::max(height, static_cast<double>(b.plan));
    found.most = std::max(found.most, height);
  }
  return found;
}

}  // namespace farhorizon
