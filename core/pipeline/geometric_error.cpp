// Sweeps over the rows of posts. Each row is placed on the globe once and compared with the
// triangles that reach it: a post's point of the mesh has the post's barycentric coordinates in the
// plan, which are taken over to the local frame.
#include "core/pipeline/geometric_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/row_span.h"

namespace farhorizon {

namespace {

// A triangle's corners in the grid and in the local frame.
struct Placed {
  std::array<Point3i, 3> plan;
  std::array<Enu, 3> local;

  // The triangle's point over post (column, row).
  [[nodiscard]] Enu At(std::int64_t column, std::int64_t row) const {
    const auto twice_area = [&](double ax, double ay, double bx, double by) {
      return ax * by - ay * bx;
    };
    const double bx = plan[1].x - plan[0].x;
    const double by = plan[1].y - plan[0].y;
    const double cx = plan[2].x - plan[0].x;
    const double cy = plan[2].y - plan[0].y;
    const auto px = static_cast<double>(column - plan[0].x);
    const auto py = static_cast<double>(row - plan[0].y);
    const double whole = twice_area(bx, by, cx, cy);
    const double v = twice_area(px, py, cx, cy) / whole;
    const double w = twice_area(bx, by, px, py) / whole;
    const double u = 1 - v - w;
    return {u * local[0].east + v * local[1].east + w * local[2].east,
            u * local[0].north + v * local[1].north + w * local[2].north,
            u * local[0].up + v * local[1].up + w * local[2].up};
  }
};

// Triangles by their first row, so that the sweep holds those alone that reach the present one.
class RowSweep {
 public:
  RowSweep(const Terrain& terrain, const LocalMesh& mesh) : terrain_(terrain), mesh_(mesh) {
    starts_.resize(static_cast<std::size_t>(terrain.dem().rows));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Placed placed = Place(t);
      const std::int32_t top = std::min({placed.plan[0].y, placed.plan[1].y, placed.plan[2].y});
      starts_[static_cast<std::size_t>(top)].push_back(t);
    }
  }

  Result<double> Greatest(const Georeference& georeference) {
    double greatest = 0;
    std::vector<std::size_t> active;
    for (std::int32_t row = 0; row < terrain_.dem().rows; ++row) {
      const std::vector<std::size_t>& starting = starts_[static_cast<std::size_t>(row)];
      active.insert(active.end(), starting.begin(), starting.end());
      Result<double> here = InRow(georeference, active, row);
      if (!here) return here;
      greatest = std::max(greatest, *here);
      std::erase_if(active, [&](std::size_t t) {
        const Placed placed = Place(t);
        return std::max({placed.plan[0].y, placed.plan[1].y, placed.plan[2].y}) <= row;
      });
    }
    return greatest;
  }

 private:
  [[nodiscard]] Placed Place(std::size_t t) const {
    Placed placed;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t vertex = mesh_.triangles[t][k];
      placed.plan[k] = terrain_.Point(static_cast<VertexId>(mesh_.posts[vertex]));
      placed.local[k] = mesh_.positions[vertex];
    }
    return placed;
  }

  // The row's greatest distance. Posts that triangles share are measured against each of them.
  Result<double> InRow(const Georeference& georeference, const std::vector<std::size_t>& active,
                       std::int32_t row) const {
    const std::int32_t columns = terrain_.dem().columns;
    std::vector<VertexId> posts;
    std::vector<std::int32_t> slot(static_cast<std::size_t>(columns), -1);
    for (std::int32_t column = 0; column < columns; ++column) {
      const VertexId v = row * columns + column;
      if (!terrain_.dem().HasData(v)) continue;
      slot[static_cast<std::size_t>(column)] = static_cast<std::int32_t>(posts.size());
      posts.push_back(v);
    }
    Result<std::vector<Geodetic>> geodetic = georeference.ToGeodetic(posts);
    if (!geodetic) return std::move(geodetic.error());
    Result<std::vector<Enu>> enu = georeference.ToEnu(*geodetic);
    if (!enu) return std::move(enu.error());
    double greatest = 0;
    for (const std::size_t t : active) {
      const Placed placed = Place(t);
      const RowSpan span = SpanOfRow(placed.plan, row);
      for (std::int64_t column = span.first; column <= span.last; ++column) {
        const std::int32_t at = slot[static_cast<std::size_t>(column)];
        if (at < 0) continue;
        const Enu p = placed.At(column, row);
        const Enu& q = (*enu)[static_cast<std::size_t>(at)];
        greatest = std::max(greatest, std::hypot(p.east - q.east, p.north - q.north, p.up - q.up));
      }
    }
    return greatest;
  }

  const Terrain& terrain_;
  const LocalMesh& mesh_;
  std::vector<std::vector<std::size_t>> starts_;
};

}  // namespace

Result<double> MeasureGeometricError(const Terrain& terrain, const Georeference& georeference,
                                     const LocalMesh& mesh) {
  return RowSweep(terrain, mesh).Greatest(georeference);
}

}  // namespace farhorizon
