// Each triangle of the DEM is compared with the triangle of the mesh over its middle, and all weigh
// alike: so the angle is what a light shows, whatever the mesh's triangles are like. The middles
// form two lattices, a third of a cell off the posts, along whose rows the mesh is scanned.
#include "core/measure/facet_look.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/measure/row_crossings.h"

namespace farhorizon {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kNeedleDegrees = 2;

// A plane's rise along a row and along a column, metres a metre.
struct Gradient {
  double by_column = 0;
  double by_row = 0;
};

// The square of the angle between two planes, radians.
double SquaredAngle(const Gradient& p, const Gradient& q) {
  const double turned = p.by_column * q.by_row - p.by_row * q.by_column;
  const double off_column = p.by_column - q.by_column;
  const double off_row = p.by_row - q.by_row;
  const double cross = off_column * off_column + off_row * off_row + turned * turned;
  const double dot = 1 + p.by_column * q.by_column + p.by_row * q.by_row;
  const double lengths = (1 + p.by_column * p.by_column + p.by_row * p.by_row) *
                         (1 + q.by_column * q.by_column + q.by_row * q.by_row);
  const double squared_sine = cross / lengths;
  if (dot > 0 && squared_sine < 0.0625) {
    // asin^2 as a series; the next term is below 1e-6 of the whole.
    return squared_sine *
           (1 + squared_sine *
                    (1.0 / 3 +
                     squared_sine *
                         (8.0 / 45 + squared_sine * (4.0 / 35 + squared_sine * 128.0 / 1575))));
  }
  const double angle = std::atan2(std::sqrt(cross), dot);
  return angle * angle;
}

class Facets {
 public:
  Facets(const Terrain& terrain, const PostPlaces& places)
      : terrain_(terrain),
        column_m_(places.column_m),
        row_m_(places.row_m),
        quantum_m_(terrain.dem().quantum_m) {}

  // Adds the triangles of a row whose middles the plane has: those at the north-eastern posts of
  // cells, or those at the south-western ones.
  void AddRow(std::int32_t row, const RowPart& part, bool north_east, const Gradient& plane) {
    const Dem& dem = terrain_.dem();
    for (std::int32_t column = part.first; column < part.end; ++column) {
      const auto nw = static_cast<std::size_t>(row * dem.columns + column);
      const std::int32_t* top = &dem.heights[nw];
      const std::int32_t* bottom = top + dem.columns;
      if (top[0] == kNoHeight || top[1] == kNoHeight || bottom[0] == kNoHeight ||
          bottom[1] == kNoHeight) {
        // Three posts make one triangle: without the south-western one it is as any other.
        if (north_east == (bottom[0] == kNoHeight)) AddBesideHole(row, column, plane);
      } else if (north_east) {
        Add(plane, Rise(top[0], top[1]), Rise(top[1], bottom[1]));
      } else {
        Add(plane, Rise(bottom[0], bottom[1]), Rise(top[0], bottom[0]));
      }
    }
  }

  [[nodiscard]] double RmsDegrees() const {
    return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) * kDegrees : 0;
  }

 private:
  [[nodiscard]] double Rise(std::int32_t from, std::int32_t to) const {
    return (static_cast<double>(to) - from) * quantum_m_;
  }

  void Add(const Gradient& plane, double along_row_m, double along_column_m) {
    squares_ += SquaredAngle(plane, {along_row_m / column_m_, along_column_m / row_m_});
    ++count_;
  }

  void AddBesideHole(std::int32_t row, std::int32_t column, const Gradient& plane) {
    const Terrain::CellTriangles cell = terrain_.Cell(column, row);
    for (int i = 0; i < cell.count; ++i) {
      // Three posts of a cell: two of them are on one row, two on one column.
      double along_row = 0;
      double along_column = 0;
      const Triangle& t = cell.triangles[static_cast<std::size_t>(i)];
      for (std::size_t k = 0; k < 3; ++k) {
        const Point3i p = terrain_.Point(t[k]);
        const Point3i q = terrain_.Point(t[(k + 1) % 3]);
        if (p.y == q.y) along_row = Rise(p.z, q.z) * (q.x - p.x);
        if (p.x == q.x) along_column = Rise(p.z, q.z) * (q.y - p.y);
      }
      Add(plane, along_row, along_column);
    }
  }

  const Terrain& terrain_;
  double column_m_;
  double row_m_;
  double quantum_m_;
  double squares_ = 0;
  std::int64_t count_ = 0;
};

// The mesh's corners in space, metres.
using Corners = std::array<StraightPoint, 3>;

StraightPoint Minus(const StraightPoint& p, const StraightPoint& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

bool IsNeedle(const Corners& corners) {
  for (std::size_t k = 0; k < 3; ++k) {
    const StraightPoint u = Minus(corners[(k + 1) % 3], corners[k]);
    const StraightPoint v = Minus(corners[(k + 2) % 3], corners[k]);
    const double cross =
        std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    const double dot = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    if (cross < std::tan(kNeedleDegrees / kDegrees) * dot) return true;
  }
  return false;
}

// Meaningless where the triangle has no area in plan; it has the middle of no cell then.
Gradient GradientOf(const Corners& corners) {
  const StraightPoint u = Minus(corners[1], corners[0]);
  const StraightPoint v = Minus(corners[2], corners[0]);
  const double area = u[0] * v[1] - u[1] * v[0];
  return {(u[2] * v[1] - u[1] * v[2]) / area, (u[0] * v[2] - u[2] * v[0]) / area};
}

}  // namespace

FacetLook MeasureFacets(const Terrain& terrain, const GridMesh& mesh, const PostPlaces& places) {
  Facets facets(terrain, places);
  std::int64_t needles = 0;
  for (const std::array<std::int32_t, 3>& t : mesh.triangles) {
    Corners corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const GridPoint& p = mesh.points[static_cast<std::size_t>(t[k])];
      corners[k] = {p.column * places.column_m, p.row * places.row_m, p.height_m};
    }
    needles += IsNeedle(corners) ? 1 : 0;
    const Gradient plane = GradientOf(corners);
    for (const bool north_east : {true, false}) {
      const GridOffset middle =
          north_east ? GridOffset{2.0 / 3, 1.0 / 3} : GridOffset{1.0 / 3, 2.0 / 3};
      ForEachRow(mesh, t, middle, terrain.dem().columns - 1, terrain.dem().rows - 1,
                 [&](std::int32_t row, const RowPart& part) {
                   facets.AddRow(row, part, north_east, plane);
                 });
    }
  }
  const auto count = static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1));
  return {facets.RmsDegrees(), static_cast<double>(needles) / count};
}

}  // namespace farhorizon
