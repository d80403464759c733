#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "core/measure/mesh_error.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The terrain's own triangles; its posts without data are points that no triangle has.
inline GridMesh MeshOf(const Terrain& terrain) {
  GridMesh mesh;
  const Dem& dem = terrain.dem();
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    mesh.points.push_back({static_cast<double>(dem.Column(v)), static_cast<double>(dem.Row(v)),
                           dem.HasData(v) ? dem.HeightM(v) : 0});
  }
  for (const Triangle& t : terrain.Triangles()) mesh.triangles.push_back({t[0], t[1], t[2]});
  return mesh;
}

/// A mesh over some columns and rows of a DEM without holes, the first and the last among them,
/// each cell between halved by one of its diagonals at random; heights are the posts'.
inline GridMesh CoarseMesh(const Dem& dem, std::mt19937& random) {
  const auto choose = [&random](std::int32_t count) {
    std::vector<std::int32_t> chosen = {0};
    for (std::int32_t i = 1; i + 1 < count; ++i) {
      if (random() % 2 == 0) chosen.push_back(i);
    }
    chosen.push_back(count - 1);
    return chosen;
  };
  const std::vector<std::int32_t> columns = choose(dem.columns);
  const std::vector<std::int32_t> rows = choose(dem.rows);
  GridMesh mesh;
  for (const std::int32_t r : rows) {
    for (const std::int32_t c : columns) {
      const VertexId v = r * dem.columns + c;
      mesh.points.push_back({static_cast<double>(c), static_cast<double>(r), dem.HeightM(v)});
    }
  }
  const auto width = static_cast<std::int32_t>(columns.size());
  for (std::int32_t r = 0; r + 1 < static_cast<std::int32_t>(rows.size()); ++r) {
    for (std::int32_t c = 0; c + 1 < width; ++c) {
      const std::int32_t nw = r * width + c;
      const std::int32_t se = nw + width + 1;
      if (random() % 2 == 0) {
        mesh.triangles.push_back({nw, se, nw + 1});
        mesh.triangles.push_back({nw, nw + width, se});
      } else {
        mesh.triangles.push_back({nw, nw + width, nw + 1});
        mesh.triangles.push_back({nw + 1, nw + width, se});
      }
    }
  }
  return mesh;
}

/// Moves each point by up to `in_plan` and `in_height` either way.
inline void Shake(GridMesh& mesh, double in_plan, double in_height, std::mt19937& random) {
  const auto by = [&random](double most) {
    return most * (static_cast<double>(random()) / 2147483648.0 - 1.0);
  };
  for (GridPoint& p : mesh.points) {
    p.column += by(in_plan);
    p.row += by(in_plan);
    p.height_m += by(in_height);
  }
}

/// A plan line through (x, y) along (dx, dy).
struct MeshLine {
  double x, y, dx, dy;
};

/// Where a surface is highest over a line: on the sides that end it, and on the others.
struct Highest {
  double outline = -std::numeric_limits<double>::infinity();
  double inner = -std::numeric_limits<double>::infinity();
  GridPoint at;  ///< of the greater

  [[nodiscard]] double height() const { return std::max(outline, inner); }
  [[nodiscard]] bool meets() const { return height() > -std::numeric_limits<double>::infinity(); }
};

/// By definition: every side of every triangle is asked.
inline Highest HighestOver(const GridMesh& mesh, const MeshLine& line) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++sides[std::minmax(t[k], t[(k + 1) % 3])];
  }
  Highest highest;
  for (const auto& [side, count] : sides) {
    const GridPoint& a = mesh.points[static_cast<std::size_t>(side.first)];
    const GridPoint& b = mesh.points[static_cast<std::size_t>(side.second)];
    const auto off = [&line](const GridPoint& p) {
      return static_cast<long double>(line.dx) * (p.row - line.y) -
             static_cast<long double>(line.dy) * (p.column - line.x);
    };
    const long double of_a = off(a);
    const long double of_b = off(b);
    if ((of_a > 0 && of_b > 0) || (of_a < 0 && of_b < 0)) continue;
    const double t = of_a == of_b ? (a.height_m >= b.height_m ? 0 : 1)
                                  : static_cast<double>(of_a / (of_a - of_b));
    const GridPoint at = {std::lerp(a.column, b.column, t), std::lerp(a.row, b.row, t),
                          std::lerp(a.height_m, b.height_m, t)};
    if (at.height_m > highest.height()) highest.at = at;
    double& kind = count == 1 ? highest.outline : highest.inner;
    kind = std::max(kind, at.height_m);
  }
  return highest;
}

/// The mesh's height at a point of the plan, in any of its triangles; nullopt where none has it.
inline std::optional<double> HeightIn(const GridMesh& mesh, double column, double row) {
  std::optional<double> found;
  for (const auto& t : mesh.triangles) {
    const auto point = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(t[k])]; };
    const auto area = [](const GridPoint& p, const GridPoint& q, double x, double y) {
      return (q.row - p.row) * (x - p.column) - (q.column - p.column) * (y - p.row);
    };
    const double of_0 = area(point(1), point(2), column, row);
    const double of_1 = area(point(2), point(0), column, row);
    const double of_2 = area(point(0), point(1), column, row);
    const double whole = of_0 + of_1 + of_2;
    if (!(whole > 0) || of_0 < 0 || of_1 < 0 || of_2 < 0) continue;
    const double height =
        (of_0 * point(0).height_m + of_1 * point(1).height_m + of_2 * point(2).height_m) / whole;
    found = std::max(found.value_or(height), height);
  }
  return found;
}

}  // namespace farhorizon
