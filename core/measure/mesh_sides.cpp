// Half-edges are dealt out by their lower point, and those of one point sorted.
#include "core/measure/mesh_sides.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace farhorizon {

namespace {

// A triangle's side, as the triangle runs along it.
struct HalfEdge {
  std::int32_t b = 0;      // the greater point
  std::int32_t right = 0;  // 0: the triangle runs from a to b, 1: from b to a
  std::int32_t triangle = 0;
  std::int32_t corner = 0;  // opposite to the side
};

// Adds the half-edges of one lower point `a`, sorted, to the sides.
void Append(std::int32_t a, const std::vector<HalfEdge>& sorted, std::size_t begin, std::size_t end,
            MeshSides& result) {
  for (std::size_t i = begin; i < end; ++i) {
    const HalfEdge& h = sorted[i];
    const bool same = i > begin && sorted[i - 1].b == h.b;
    const auto slot = h.right == 0 ? &MeshSide::left : &MeshSide::right;
    if (!same || result.sides.back().*slot != kNoneThere) {
      if (same) ++result.crowded;
      result.sides.push_back({a, h.b});
    }
    result.sides.back().*slot = h.triangle;
    result.of_triangle[static_cast<std::size_t>(h.triangle)][static_cast<std::size_t>(h.corner)] =
        static_cast<std::int32_t>(result.sides.size() - 1);
  }
}

}  // namespace

MeshSides SidesOf(const GridMesh& mesh) {
  std::vector<std::size_t> start(mesh.points.size() + 1, 0);
  const auto each = [&mesh](auto&& visit) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t from = mesh.triangles[t][(k + 1) % 3];
        const std::int32_t to = mesh.triangles[t][(k + 2) % 3];
        visit(static_cast<std::size_t>(std::min(from, to)),
              HalfEdge{std::max(from, to), from < to ? 0 : 1, static_cast<std::int32_t>(t),
                       static_cast<std::int32_t>(k)});
      }
    }
  };
  each([&start](std::size_t a, const HalfEdge&) { ++start[a + 1]; });
  for (std::size_t a = 0; a + 1 < start.size(); ++a) start[a + 1] += start[a];
  std::vector<HalfEdge> half_edges(start.back());
  std::vector<std::size_t> next(start.begin(), start.end());
  each([&](std::size_t a, const HalfEdge& h) { half_edges[next[a]++] = h; });

  MeshSides result;
  result.sides.reserve(half_edges.size() / 2);
  result.of_triangle.resize(mesh.triangles.size());
  for (std::size_t a = 0; a + 1 < start.size(); ++a) {
    std::sort(half_edges.begin() + static_cast<std::ptrdiff_t>(start[a]),
              half_edges.begin() + static_cast<std::ptrdiff_t>(start[a + 1]),
              [](const HalfEdge& p, const HalfEdge& q) {
                return std::tie(p.b, p.right, p.triangle) < std::tie(q.b, q.right, q.triangle);
              });
    Append(static_cast<std::int32_t>(a), half_edges, start[a], start[a + 1], result);
  }
  return result;
}

bool IsRidgeOrOutline(const GridMesh& mesh, const MeshSide& side) {
  if (side.IsOutline()) return true;
  const auto third = [&](std::int32_t triangle) {
    const std::array<std::int32_t, 3>& t = mesh.triangles[static_cast<std::size_t>(triangle)];
    for (const std::int32_t i : t) {
      if (i != side.a && i != side.b) return mesh.points[static_cast<std::size_t>(i)];
    }
    return mesh.points[static_cast<std::size_t>(side.a)];
  };
  const GridPoint& a = mesh.points[static_cast<std::size_t>(side.a)];
  const GridPoint& b = mesh.points[static_cast<std::size_t>(side.b)];
  const GridPoint c = third(side.left);
  const GridPoint d = third(side.right);
  const auto x = [&a](const GridPoint& p) { return p.column - a.column; };
  const auto y = [&a](const GridPoint& p) { return a.row - p.row; };
  const auto z = [&a](const GridPoint& p) { return p.height_m - a.height_m; };
  // Areas of a, b, c and of a, d, b: negative where a triangle is flipped.
  const double of_c = x(b) * y(c) - x(c) * y(b);
  const double of_d = x(d) * y(b) - x(b) * y(d);
  if (!(of_c > 0) || !(of_d > 0)) return true;
  // Six times the volume of a, b, c, d: positive where d is above the plane of a, b, c.
  const double terms[3] = {z(b) * (x(c) * y(d) - x(d) * y(c)), z(c) * (x(d) * y(b) - x(b) * y(d)),
                           z(d) * of_c};
  const double size = std::abs(terms[0]) + std::abs(terms[1]) + std::abs(terms[2]);
  // Far above what the products' rounding can be.
  return terms[0] + terms[1] + terms[2] <= 1e-12 * size;
}

}  // namespace farhorizon
