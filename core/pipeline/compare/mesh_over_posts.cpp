// Triangles over the plan, row by row of posts.
#include "core/pipeline/compare/mesh_over_posts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace farhorizon {

namespace {

// Rounding of vertices moves a rim by hundredths of a cell: posts that close to a triangle are
// covered by it.
constexpr double kRim = 0.05;
// Work is bounded: a surface covers the plan once, and its triangles have a few rows each, those of
// a fan all of them. The latter number of steps takes half a minute.
constexpr double kMostLayers = 64;
constexpr double kMostRows = 4e9;
// Skirts are upright within the tilt of the vertical over a tile, a hundredth in 60 km. Cliffs may
// be as steep, but all their corners are on the ground.
constexpr double kWallShare = 0.02;

struct Corners {
  std::array<GridPoint, 3> p;

  Corners(const GridMesh& mesh, const std::array<std::int32_t, 3>& t)
      : p{mesh.points[static_cast<std::size_t>(t[0])], mesh.points[static_cast<std::size_t>(t[1])],
          mesh.points[static_cast<std::size_t>(t[2])]} {}

  // Twice the area in the plan (column, -row).
  [[nodiscard]] double Turn() const {
    return (p[2].column - p[0].column) * (p[1].row - p[0].row) -
           (p[1].column - p[0].column) * (p[2].row - p[0].row);
  }
  [[nodiscard]] double LeastRow() const { return std::min({p[0].row, p[1].row, p[2].row}); }
  [[nodiscard]] double MostRow() const { return std::max({p[0].row, p[1].row, p[2].row}); }
  [[nodiscard]] double LeastColumn() const {
    return std::min({p[0].column, p[1].column, p[2].column});
  }
  [[nodiscard]] double MostColumn() const {
    return std::max({p[0].column, p[1].column, p[2].column});
  }
};

bool IsWall(const Corners& t, double cell_m) {
  const std::array<double, 3> u = {(t.p[1].column - t.p[0].column) * cell_m,
                                   (t.p[1].row - t.p[0].row) * cell_m,
                                   t.p[1].height_m - t.p[0].height_m};
  const std::array<double, 3> v = {(t.p[2].column - t.p[0].column) * cell_m,
                                   (t.p[2].row - t.p[0].row) * cell_m,
                                   t.p[2].height_m - t.p[0].height_m};
  const double upright = std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]);
  return std::abs(t.Turn()) * cell_m * cell_m < kWallShare * upright;
}

// The columns that a triangle has on a row within it; from > to where none.
std::array<double, 2> ColumnsOn(const Corners& t, double row) {
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPoint& a = t.p[k];
    const GridPoint& b = t.p[(k + 1) % 3];
    if (std::min(a.row, b.row) > row || std::max(a.row, b.row) < row) continue;
    const double share = a.row == b.row ? 0 : (row - a.row) / (b.row - a.row);
    for (const double x : {a.column + share * (b.column - a.column),
                           a.row == b.row ? b.column : a.column + share * (b.column - a.column)}) {
      from = std::min(from, x);
      to = std::max(to, x);
    }
  }
  return {from, to};
}

// The integers from `from` to `to` that are from 0 to count - 1.
std::array<std::int32_t, 2> Clamped(double from, double to, std::int32_t count) {
  const double least = std::clamp(std::ceil(from), 0.0, double(count));
  const double most = std::clamp(std::floor(to), -1.0, count - 1.0);
  return {static_cast<std::int32_t>(least), static_cast<std::int32_t>(most)};
}

void Cover(const Corners& t, const Dem& dem, std::vector<double>& heights) {
  const double turn = t.Turn();
  if (turn == 0) return;
  const auto [first_row, last_row] = Clamped(t.LeastRow() - kRim, t.MostRow() + kRim, dem.rows);
  for (std::int32_t row = first_row; row <= last_row; ++row) {
    const auto [from, to] = ColumnsOn(t, std::clamp<double>(row, t.LeastRow(), t.MostRow()));
    const auto [first, last] = Clamped(from - kRim, to + kRim, dem.columns);
    for (std::int32_t column = first; column <= last; ++column) {
      // The plane through the corners, by the areas opposite to them.
      const double x = column - t.p[0].column;
      const double y = row - t.p[0].row;
      const double second = ((t.p[2].column - t.p[0].column) * y - x * (t.p[2].row - t.p[0].row));
      const double third = (x * (t.p[1].row - t.p[0].row) - (t.p[1].column - t.p[0].column) * y);
      const double height = t.p[0].height_m + (second * (t.p[1].height_m - t.p[0].height_m) +
                                               third * (t.p[2].height_m - t.p[0].height_m)) /
                                                  turn;
      double& known =
          heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(dem.columns) +
                  static_cast<std::size_t>(column)];
      if (std::isnan(known)) known = height;
    }
  }
}

}  // namespace

bool TurnCounterClockwise(GridMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) sum += Corners(mesh, t).Turn();
  if (sum >= 0) return false;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return true;
}

std::int64_t DropSkirts(GridMesh& mesh, double cell_m) {
  std::vector<bool> upright(mesh.triangles.size());
  std::vector<bool> on_ground(mesh.points.size(), false);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    upright[i] = IsWall(Corners(mesh, mesh.triangles[i]), cell_m);
    for (const std::int32_t v : mesh.triangles[i]) {
      if (!upright[i]) on_ground[static_cast<std::size_t>(v)] = true;
    }
  }
  // A skirt hangs: its corners that are not on the ground are no higher than those that are.
  const auto hangs = [&](const std::array<std::int32_t, 3>& t) {
    double ground = -std::numeric_limits<double>::infinity();
    double other = ground;
    for (const std::int32_t v : t) {
      const auto i = static_cast<std::size_t>(v);
      double& highest = on_ground[i] ? ground : other;
      highest = std::max(highest, mesh.points[i].height_m);
    }
    return std::isfinite(other) && other <= ground;
  };
  std::vector<std::array<std::int32_t, 3>> kept;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!upright[i] || !hangs(mesh.triangles[i])) kept.push_back(mesh.triangles[i]);
  }
  const auto dropped = static_cast<std::int64_t>(mesh.triangles.size() - kept.size());
  mesh.triangles = std::move(kept);
  return dropped;
}

Result<std::vector<double>> HeightsOverPosts(const GridMesh& mesh, const Dem& dem) {
  double posts = 0;  // that are looked at, about
  double rows = 0;
  for (const auto& triangle : mesh.triangles) {
    const Corners t(mesh, triangle);
    const double height =
        std::max(std::min(t.MostRow(), dem.rows - 1.0) - std::max(t.LeastRow(), 0.0), 0.0);
    const double width =
        std::max(std::min(t.MostColumn(), dem.columns - 1.0) - std::max(t.LeastColumn(), 0.0), 0.0);
    posts += std::min(std::abs(t.Turn()) / 2, width * height);
    rows += height;
  }
  if (posts > kMostLayers * dem.columns * dem.rows || rows > kMostRows) {
    return Error{ErrorCode::kUnsupportedData,
                 "the triangles cover the DEM more than 64 times, or run all over it; is this a "
                 "surface over the ground?",
                 "overlap"};
  }
  std::vector<double> heights(
      static_cast<std::size_t>(dem.columns) * static_cast<std::size_t>(dem.rows),
      std::numeric_limits<double>::quiet_NaN());
  for (const auto& triangle : mesh.triangles) Cover(Corners(mesh, triangle), dem, heights);
  return heights;
}

}  // namespace farhorizon
