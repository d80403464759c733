// Every triangle is walked row by row over the points of a lattice: the posts, or the middles of
// one half of the cells. A point on the edge of two triangles is counted once, by the first of
// them. Points up to kRim cells outside the mesh take the plane of the nearest triangle, once all
// others are settled: a codec that rounds a vertex of the outline leaves posts that far outside.
#include "surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace farhorizon::peers {

namespace {

constexpr double kOnEdge =
    1e-6;                      // cells; a float32 column of 1201 is rounded by up to 6e-5: see kRim
constexpr double kRim = 0.06;  // cells; 16 bits a coordinate round by less up to 7,800 posts a side

/// The plane of a triangle, and what of each row lies within it.
class Facet {
 public:
  static std::optional<Facet> Of(const Mesh& mesh, const std::array<std::int32_t, 3>& corners) {
    Facet facet;
    for (int i = 0; i < 3; ++i)
      facet.corners_[i] = mesh.vertices[static_cast<std::size_t>(corners[i])];
    const auto& [a, b, c] = facet.corners_;
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (std::abs(area) < 1e-12) return std::nullopt;  // upright, or nothing: covers no point
    if (area < 0) std::swap(facet.corners_[1], facet.corners_[2]);
    const auto& [p, q, r] = facet.corners_;
    facet.slope_x_ = ((q.z - p.z) * (r.y - p.y) - (r.z - p.z) * (q.y - p.y)) / std::abs(area);
    facet.slope_y_ = ((q.x - p.x) * (r.z - p.z) - (r.x - p.x) * (q.z - p.z)) / std::abs(area);
    return facet;
  }

  [[nodiscard]] double HeightAt(double x, double y) const {
    return corners_[0].z + slope_x_ * (x - corners_[0].x) + slope_y_ * (y - corners_[0].y);
  }
  [[nodiscard]] double slope_x() const { return slope_x_; }  // metres a column
  [[nodiscard]] double slope_y() const { return slope_y_; }  // metres a row

  /// Calls visit(column, row) for each point (column + at.x, row + at.y) of the grid's `columns` x
  /// `rows` lattice that lies inside, or outside by no more than `margin` from each edge.
  template <typename Visit>
  void ForEachPoint(Point at, std::int32_t columns, std::int32_t rows, double margin,
                    const Visit& visit) const {
    const auto [low, high] = std::minmax({corners_[0].y, corners_[1].y, corners_[2].y});
    const double first = std::max(0., std::ceil(low - margin - at.y));
    const double last = std::min(rows - 1., std::floor(high + margin - at.y));
    for (double row = first; row <= last; ++row) {
      const auto [from, to] = Within(row + at.y, margin);
      const double begin = std::max(0., std::ceil(from - at.x));
      const double end = std::min(columns - 1., std::floor(to - at.x));
      for (double column = begin; column <= end; ++column)
        visit(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
    }
  }

 private:
  struct Range {
    double from, to;  // empty where from > to
  };

  /// The x of the points of row y that are no further than `margin` outside any of the three edges.
  [[nodiscard]] Range Within(double y, double margin) const {
    const auto [left, right] = std::minmax({corners_[0].x, corners_[1].x, corners_[2].x});
    Range range{left - margin, right + margin};
    for (int i = 0; i < 3; ++i) {
      const Point &p = corners_[i], &q = corners_[(i + 1) % 3];
      const double dx = q.x - p.x, dy = q.y - p.y;
      // Inside: dx (y - p.y) - dy (x - p.x) >= -margin |pq|
      const double reach = dx * (y - p.y) + margin * std::hypot(dx, dy);
      if (dy > 0)
        range.to = std::min(range.to, p.x + reach / dy);
      else if (dy < 0)
        range.from = std::max(range.from, p.x + reach / dy);
      else if (reach < 0)
        return {1, 0};
    }
    return range;
  }

  std::array<Point, 3> corners_{};
  double slope_x_ = 0, slope_y_ = 0;
};

/// Gives each asked point of a lattice to one facet: visit(index of the point, facet). Asked points
/// are those with a 1 in `asked`, whose ones go as they are given. Returns how many are left.
template <typename Visit>
std::int64_t GiveOut(const Mesh& mesh, const Grid& grid, Point at, std::vector<char>& asked,
                     const Visit& visit) {
  for (const double margin : {kOnEdge, kRim}) {
    if (std::find(asked.begin(), asked.end(), 1) == asked.end()) break;
    for (const auto& triangle : mesh.triangles) {
      const std::optional<Facet> facet = Facet::Of(mesh, triangle);
      if (!facet) continue;
      facet->ForEachPoint(at, grid.columns, grid.rows, margin,
                          [&](std::int32_t column, std::int32_t row) {
                            const std::size_t point = grid.At(column, row);
                            if (!asked[point]) return;
                            asked[point] = 0;
                            visit(point, *facet);
                          });
    }
  }
  return std::count(asked.begin(), asked.end(), 1);
}

double Degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// Sum of the squared angles between normals over one half of the cells.
struct Tilt {
  double squares = 0;
  std::int64_t facets = 0;
};

/// Angle between the normals of two surfaces by their slopes, rise over run, degrees.
double AngleBetween(double x1, double y1, double x2, double y2) {
  const double cross_x = y2 - y1, cross_y = x1 - x2, cross_z = x1 * y2 - x2 * y1;
  return Degrees(std::atan2(std::hypot(cross_x, cross_y, cross_z), 1 + x1 * x2 + y1 * y2));
}

}  // namespace

VerticalErrors VerticalErrorsOf(const Mesh& mesh, const Grid& grid) {
  std::vector<char> asked(grid.heights.size(), 0);
  for (const auto& triangle : FullMesh(grid).triangles)
    for (const std::int32_t post : triangle) asked[static_cast<std::size_t>(post)] = 1;
  const std::int64_t posts = std::count(asked.begin(), asked.end(), 1);
  VerticalErrors errors;
  double squares = 0;
  errors.uncovered =
      GiveOut(mesh, grid, {0, 0, 0}, asked, [&](std::size_t post, const Facet& facet) {
        const Point p = grid.PointAt(post);
        const double error = std::abs(facet.HeightAt(p.x, p.y) - p.z);
        errors.max = std::max(errors.max, error);
        squares += error * error;
      });
  errors.rms =
      std::sqrt(squares / static_cast<double>(std::max<std::int64_t>(posts - errors.uncovered, 1)));
  return errors;
}

double FacetAngleRms(const Mesh& mesh, const Grid& grid, Cell cell) {
  // Each facet of the DEM belongs to the cell of its least column and row; of the two in a cell,
  // the one with the longer way along the row first. A cell with one post missing keeps one facet,
  // whose middle may be any of four: those few at holes are left out.
  const Mesh full = FullMesh(grid);
  Tilt tilt;
  for (const bool upper : {true, false}) {
    std::vector<char> asked(grid.heights.size(), 0);
    std::vector<std::array<double, 2>> slopes(grid.heights.size());
    for (const auto& triangle : full.triangles) {
      const std::int32_t a = triangle[0], b = triangle[1], c = triangle[2];
      const bool is_upper = b == a + 1 && c == b + grid.columns;
      const bool is_lower = b == a + grid.columns + 1 && c + 1 == b;
      if (upper ? !is_upper : !is_lower) continue;
      const auto facet = Facet::Of(full, triangle);
      asked[static_cast<std::size_t>(a)] = 1;
      slopes[static_cast<std::size_t>(a)] = {facet->slope_x() / cell.x, facet->slope_y() / cell.y};
    }
    const Point middle = upper ? Point{2. / 3, 1. / 3, 0} : Point{1. / 3, 2. / 3, 0};
    GiveOut(mesh, grid, middle, asked, [&](std::size_t post, const Facet& facet) {
      const double angle = AngleBetween(slopes[post][0], slopes[post][1], facet.slope_x() / cell.x,
                                        facet.slope_y() / cell.y);
      tilt.squares += angle * angle;
      ++tilt.facets;
    });
  }
  return std::sqrt(tilt.squares / static_cast<double>(std::max<std::int64_t>(tilt.facets, 1)));
}

double NeedleShare(const Mesh& mesh, Cell cell, double degrees) {
  std::int64_t needles = 0;
  for (const auto& triangle : mesh.triangles) {
    std::array<Point, 3> corners{};
    for (int i = 0; i < 3; ++i) {
      const Point& p = mesh.vertices[static_cast<std::size_t>(triangle[i])];
      corners[i] = {p.x * cell.x, p.y * cell.y, p.z};
    }
    double least = 180;
    for (int i = 0; i < 3; ++i) {
      const Point &p = corners[i], &q = corners[(i + 1) % 3], &r = corners[(i + 2) % 3];
      const Point u{q.x - p.x, q.y - p.y, q.z - p.z}, v{r.x - p.x, r.y - p.y, r.z - p.z};
      const double cross =
          std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
      least = std::min(least, Degrees(std::atan2(cross, u.x * v.x + u.y * v.y + u.z * v.z)));
    }
    needles += least < degrees;
  }
  return static_cast<double>(needles) /
         static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1));
}

}  // namespace farhorizon::peers
