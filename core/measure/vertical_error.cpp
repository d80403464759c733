// Every triangle is rasterised: its error is computed at each post in it. A post on an edge is in
// two triangles and keeps the greater error. Posts that are in none, as vertices on the outline
// have moved inwards, are compared with the nearest point of the outline.
// Cost: the posts in the bounding boxes of the triangles; the outline's edges for each post
// outside.
#include "core/measure/vertical_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace farhorizon {

namespace {

using Indices = std::array<std::int32_t, 3>;

class PostHeights {
 public:
  PostHeights(const Terrain& terrain, const GridMesh& mesh)
      : terrain_(terrain),
        mesh_(mesh),
        errors_(static_cast<std::size_t>(terrain.post_count()), -1.0) {
    for (const Indices& t : mesh.triangles) Rasterise(t);
  }

  ErrorMeasure Measure() {
    double greatest = 0;
    double squares = 0;
    std::int64_t posts = 0;
    for (VertexId v = 0; v < terrain_.post_count(); ++v) {
      if (!terrain_.IsVertex(v)) continue;
      double& error = errors_[static_cast<std::size_t>(v)];
      if (error < 0) error = std::abs(HeightOfOutline(v) - terrain_.dem().HeightM(v));
      greatest = std::max(greatest, error);
      squares += error * error;
      ++posts;
    }
    return {greatest, std::sqrt(squares / static_cast<double>(posts))};
  }

 private:
  [[nodiscard]] const GridPoint& Point(std::int32_t i) const {
    return mesh_.points[static_cast<std::size_t>(i)];
  }

  // Twice the area of the points i, j and (x, y) in the plan (column, -row), positive where they
  // turn counter-clockwise. Computed for i < j alone, so that the two triangles at an edge get
  // opposite numbers in spite of rounding, and every post beside the edge is in one of them.
  [[nodiscard]] double Turn(std::int32_t i, std::int32_t j, double x, double y) const {
    if (i > j) return -Turn(j, i, x, y);
    const GridPoint& p = Point(i);
    const GridPoint& q = Point(j);
    return (q.row - p.row) * (x - p.column) - (q.column - p.column) * (y - p.row);
  }

  // Compares the posts in the triangle; a post on its edges is in it.
  void Rasterise(const Indices& t) {
    const auto [left, right] =
        std::minmax({Point(t[0]).column, Point(t[1]).column, Point(t[2]).column});
    const auto [top, bottom] = std::minmax({Point(t[0]).row, Point(t[1]).row, Point(t[2]).row});
    const Dem& dem = terrain_.dem();
    const auto first_row = std::max(0, static_cast<std::int32_t>(std::ceil(top)));
    const auto last_row = std::min(dem.rows - 1, static_cast<std::int32_t>(std::floor(bottom)));
    const auto first_column = std::max(0, static_cast<std::int32_t>(std::ceil(left)));
    const auto last_column =
        std::min(dem.columns - 1, static_cast<std::int32_t>(std::floor(right)));
    for (std::int32_t r = first_row; r <= last_row; ++r) {
      for (std::int32_t c = first_column; c <= last_column; ++c) {
        if (dem.HasData(r * dem.columns + c)) Compare(t, c, r);
      }
    }
  }

  void Compare(const Indices& t, std::int32_t c, std::int32_t r) {
    const double of_0 = Turn(t[1], t[2], c, r);
    const double of_1 = Turn(t[2], t[0], c, r);
    const double of_2 = Turn(t[0], t[1], c, r);
    if (of_0 < 0 || of_1 < 0 || of_2 < 0) return;
    const VertexId v = r * terrain_.dem().columns + c;
    const double height =
        (of_0 * Point(t[0]).height_m + of_1 * Point(t[1]).height_m + of_2 * Point(t[2]).height_m) /
        (of_0 + of_1 + of_2);
    double& error = errors_[static_cast<std::size_t>(v)];
    error = std::max(error, std::abs(height - terrain_.dem().HeightM(v)));
  }

  // The directed sides of triangles without an opposite one.
  void FindOutline() {
    std::set<std::pair<std::int32_t, std::int32_t>> sides;
    for (const Indices& t : mesh_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::pair<std::int32_t, std::int32_t> opposite = {t[(k + 1) % 3], t[k]};
        if (sides.erase(opposite) == 0) sides.insert({t[k], t[(k + 1) % 3]});
      }
    }
    outline_.assign(sides.begin(), sides.end());
  }

  // The height of the outline at its point nearest to the post, in plan.
  double HeightOfOutline(VertexId v) {
    if (outline_.empty()) FindOutline();
    const double x = terrain_.dem().Column(v);
    const double y = terrain_.dem().Row(v);
    double nearest = std::numeric_limits<double>::infinity();
    double height = 0;
    for (const auto& [i, j] : outline_) {
      const GridPoint& p = Point(i);
      const GridPoint& q = Point(j);
      const double dx = q.column - p.column;
      const double dy = q.row - p.row;
      const double t =
          std::clamp(((x - p.column) * dx + (y - p.row) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
      const double off_x = p.column + t * dx - x;
      const double off_y = p.row + t * dy - y;
      const double distance = off_x * off_x + off_y * off_y;
      if (distance >= nearest) continue;
      nearest = distance;
      height = p.height_m + t * (q.height_m - p.height_m);
    }
    return height;
  }

  const Terrain& terrain_;
  const GridMesh& mesh_;
  std::vector<double> errors_;  // per post; -1 where no triangle has it
  std::vector<std::pair<std::int32_t, std::int32_t>> outline_;
};

}  // namespace

ErrorMeasure VerticalError(const Terrain& terrain, const GridMesh& mesh) {
  return PostHeights(terrain, mesh).Measure();
}

}  // namespace farhorizon
