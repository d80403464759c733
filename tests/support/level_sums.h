#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/simplify/lines/pencils.h"
#include "core/simplify/mesh/half_edge_mesh.h"
#include "core/simplify/mesh/squares.h"

namespace farhorizon {

/// Whether the rim runs straight through its vertex v.
inline bool RimIsStraight(const HalfEdgeMesh& mesh, std::int32_t v) {
  const std::vector<std::int32_t> spokes = mesh.GatherRim(v);
  return Turn(mesh.at(mesh.origin(HalfEdgeMesh::Next(spokes.front()))), mesh.at(v),
              mesh.at(mesh.origin(HalfEdgeMesh::Previous(spokes.back())))) == 0;
}

/// The mesh's height in the tile's frame at post (x, y), doubles: each triangle is looked at.
/// Infinity where none covers the post.
inline double FrameHeightByDefinition(const HalfEdgeMesh& mesh, std::int32_t x, std::int32_t y) {
  Place p;
  p.x = static_cast<std::int16_t>(x);
  p.y = static_cast<std::int16_t>(y);
  for (std::int32_t h = 0; h < mesh.half_edges(); h += 3) {
    if (!mesh.Stands(h / 3)) continue;
    const Place& a = mesh.at(mesh.origin(h));
    const Place& b = mesh.at(mesh.origin(h + 1));
    const Place& c = mesh.at(mesh.origin(h + 2));
    const auto of_a = static_cast<double>(Turn(p, b, c));
    const auto of_b = static_cast<double>(Turn(a, p, c));
    const auto of_c = static_cast<double>(Turn(a, b, p));
    if (of_a < 0 || of_b < 0 || of_c < 0) continue;
    return (of_a * static_cast<double>(a.frame) + of_b * static_cast<double>(b.frame) +
            of_c * static_cast<double>(c.frame)) /
           (of_a + of_b + of_c);
  }
  return std::numeric_limits<double>::infinity();
}

/// visit(what the mesh is off at a post) for each post of the terrain's domain.
template <typename Visit>
void ForEachErrorByDefinition(const HalfEdgeMesh& mesh, Visit visit) {
  const Ground& ground = mesh.ground();
  for (VertexId v = 0; v < mesh.vertices(); ++v) {
    if (!ground.terrain().IsVertex(v)) continue;
    const std::int32_t x = v % ground.columns();
    const std::int32_t y = v / ground.columns();
    visit(static_cast<double>(ground.Row(y)[x]) - FrameHeightByDefinition(mesh, x, y));
  }
}

/// The sum over the posts of the domain of (f' - f)^2.
inline double SquaresByDefinition(const HalfEdgeMesh& mesh) {
  double sum = 0;
  ForEachErrorByDefinition(mesh, [&](double off) { sum += off * off; });
  return sum;
}
inline double GreatestErrorByDefinition(const HalfEdgeMesh& mesh) {
  double greatest = 0;
  ForEachErrorByDefinition(mesh, [&](double off) { greatest = std::max(greatest, std::abs(off)); });
  return greatest;
}

/// The same sum as the simplifier has it: over triangles and the rim.
inline double SquaresOf(const HalfEdgeMesh& mesh,
                        float most_m = std::numeric_limits<float>::infinity()) {
  const Ground& ground = mesh.ground();
  double sum = 0;
  for (std::int32_t h = 0; h < mesh.half_edges(); ++h) {
    if (!mesh.Stands(h / 3)) continue;
    const Place& a = mesh.at(mesh.origin(h));
    const Place& b = mesh.at(mesh.origin(HalfEdgeMesh::Next(h)));
    const Place& c = mesh.at(mesh.origin(HalfEdgeMesh::Previous(h)));
    if (h % 3 == 0) sum += static_cast<double>(Squares(ground, a, b, c, most_m));
    if (mesh.twin(h) == HalfEdgeMesh::kNone) {
      sum += static_cast<double>(RimSquares(ground, a, b, most_m));
    }
  }
  return sum;
}

/// A bracket of the mesh's greatest height over a line: `least` without the edges that end within
/// 1e-3 cells of the line, `most` with those that fail to meet it by less. -infinity: none.
struct HeightBracket {
  double least = -std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
};
inline HeightBracket HeightOverByDefinition(const HalfEdgeMesh& mesh, const Pencils::Pencil& pencil,
                                            std::int32_t i) {
  constexpr double kBeside = 1e-3;
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
    double height = static_cast<double>(a.plan) +
                    share * (static_cast<double>(b.plan) - static_cast<double>(a.plan));
    if (std::min(s, t) < -kBeside && std::max(s, t) > kBeside) {
      found.least = std::max(found.least, height);
    }
    if (std::abs(s) < kBeside) height = std::max(height, static_cast<double>(a.plan));
    if (std::abs(t) < kBeside) height = std::max(height, static_cast<double>(b.plan));
    found.most = std::max(found.most, height);
  }
  return found;
}

}  // namespace farhorizon
