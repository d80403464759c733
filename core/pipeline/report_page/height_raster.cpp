// A triangle is drawn row by row of the samples, each from its left to its right side, ends
// included. A side that two triangles share is crossed at the same place for both, since its ends
// are put in one order first: no sample between them is left out.
#include "core/pipeline/report_page/height_raster.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace farhorizon {

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

struct Sample {
  double x = 0;
  double y = 0;
  double height = 0;
};

// Where the side pq crosses the row y. Requires: it does, and p.y != q.y.
double Crossing(const Sample& p, const Sample& q, double y) {
  const bool in_order = std::pair(p.y, p.x) < std::pair(q.y, q.x);
  const Sample& a = in_order ? p : q;
  const Sample& b = in_order ? q : p;
  return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
}

class Drawing {
 public:
  explicit Drawing(const PictureFrame& frame)
      : columns_(frame.sample_columns()),
        rows_(frame.sample_rows()),
        heights_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNone) {}

  void Add(const std::array<Sample, 3>& t) {
    const double area =
        (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
    if (area == 0) return;
    const double dx = ((t[1].height - t[0].height) * (t[2].y - t[0].y) -
                       (t[2].height - t[0].height) * (t[1].y - t[0].y)) /
                      area;
    const double dy = ((t[2].height - t[0].height) * (t[1].x - t[0].x) -
                       (t[1].height - t[0].height) * (t[2].x - t[0].x)) /
                      area;
    const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
    const int last = std::min(static_cast<int>(std::floor(bottom)), rows_ - 1);
    for (int y = std::max(static_cast<int>(std::ceil(top)), 0); y <= last; ++y) {
      const auto [left, right] = Span(t, y);
      const int from = std::max(static_cast<int>(std::ceil(left)), 0);
      const int to = std::min(static_cast<int>(std::floor(right)), columns_ - 1);
      float* const row =
          &heights_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_)];
      for (int x = from; x <= to; ++x) {
        row[x] = static_cast<float>(t[0].height + (x - t[0].x) * dx + (y - t[0].y) * dy);
      }
    }
  }

  std::vector<float> Take() { return std::move(heights_); }

 private:
  static std::array<double, 2> Span(const std::array<Sample, 3>& t, double y) {
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (std::size_t i = 0; i < 3; ++i) {
      const Sample& p = t[i];
      const Sample& q = t[(i + 1) % 3];
      if (p.y == q.y || y < std::min(p.y, q.y) || y > std::max(p.y, q.y)) continue;
      const double x = Crossing(p, q, y);
      left = std::min(left, x);
      right = std::max(right, x);
    }
    return {left, right};
  }

  int columns_;
  int rows_;
  std::vector<float> heights_;
};

// The height of the terrain at a place in the cell of `column` and `row`, as share of a cell; NaN
// where its triangle is missing.
double HeightInCell(const Terrain& terrain, double column, double row) {
  const Dem& dem = terrain.dem();
  const auto c = std::min(static_cast<std::int32_t>(column), dem.columns - 2);
  const auto r = std::min(static_cast<std::int32_t>(row), dem.rows - 2);
  const double u = column - c;
  const double v = row - r;
  const Terrain::CellTriangles cell = terrain.Cell(c, r);
  for (int i = 0; i < cell.count; ++i) {
    const Triangle& t = cell.triangles[static_cast<std::size_t>(i)];
    const auto at = [&dem, c, r, u, v](VertexId post) {
      return std::array{dem.Column(post) - c - u, dem.Row(post) - r - v};
    };
    const std::array<std::array<double, 2>, 3> p = {at(t[0]), at(t[1]), at(t[2])};
    // The weights of the corners, each times twice the triangle's area of half a cell.
    std::array<double, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [x1, y1] = p[(k + 1) % 3];
      const auto& [x2, y2] = p[(k + 2) % 3];
      weights[k] = x2 * y1 - x1 * y2;
    }
    if (*std::min_element(weights.begin(), weights.end()) < 0) continue;
    // From one corner: level ground is exactly level.
    const double first = dem.HeightM(t[0]);
    return first + weights[1] * (dem.HeightM(t[1]) - first) +
           weights[2] * (dem.HeightM(t[2]) - first);
  }
  return kNone;
}

double LeastHeight(const Dem& dem) {
  double least = std::numeric_limits<double>::infinity();
  for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
    if (dem.HasData(v)) least = std::min(least, dem.HeightM(v));
  }
  return least;
}

}  // namespace

HeightRaster RasterOf(const Terrain& terrain, const PictureFrame& frame) {
  HeightRaster raster{{}, LeastHeight(terrain.dem())};
  raster.heights_m.reserve(static_cast<std::size_t>(frame.sample_columns()) *
                           static_cast<std::size_t>(frame.sample_rows()));
  for (int y = 0; y < frame.sample_rows(); ++y) {
    const double row = frame.RowAt(y);
    for (int x = 0; x < frame.sample_columns(); ++x) {
      const double height = HeightInCell(terrain, frame.ColumnAt(x), row);
      raster.heights_m.push_back(static_cast<float>(height - raster.base_m));
    }
  }
  return raster;
}

HeightRaster RasterOf(const GridMesh& mesh, const PictureFrame& frame, double base_m) {
  Drawing drawing(frame);
  const auto sample = [&](std::int32_t i) {
    const GridPoint& p = mesh.points[static_cast<std::size_t>(i)];
    return Sample{frame.SampleX(p.column), frame.SampleY(p.row), p.height_m - base_m};
  };
  for (const std::array<std::int32_t, 3>& t : mesh.triangles) {
    drawing.Add({sample(t[0]), sample(t[1]), sample(t[2])});
  }
  return {drawing.Take(), base_m};
}

}  // namespace farhorizon
