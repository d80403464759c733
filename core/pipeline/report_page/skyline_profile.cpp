// By definition: the skyline over a line of sight is the highest of the edges that it crosses, in
// the plan. That is drawn, nothing is measured by it, so edges go into the envelope one by one and
// no order of sweep is needed.
#include "core/pipeline/report_page/skyline_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace farhorizon {

namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

// A point as parallel lines have it.
struct Above {
  double offset = 0;
  double height_m = 0;
};

// Takes edge after edge, and keeps what is greatest over each line.
class Envelope {
 public:
  explicit Envelope(const ParallelLines& lines)
      : lines_(lines), heights_(static_cast<std::size_t>(lines.count), kNoHeight) {}

  void Add(Above a, Above b) {
    if (a.offset > b.offset) std::swap(a, b);
    const int first = std::max(LineAtOrAfter(a.offset), 0);
    for (int i = first; i < lines_.count && lines_.OffsetOfLine(i) <= b.offset; ++i) {
      // An edge along the line is as high as its higher end.
      const double width = b.offset - a.offset;
      const double height =
          width > 0 ? std::lerp(a.height_m, b.height_m,
                                std::clamp((lines_.OffsetOfLine(i) - a.offset) / width, 0.0, 1.0))
                    : std::max(a.height_m, b.height_m);
      double& greatest = heights_[static_cast<std::size_t>(i)];
      if (!(greatest >= height)) greatest = height;
    }
  }

  SkylineProfile Take() { return std::move(heights_); }

 private:
  [[nodiscard]] int LineAtOrAfter(double offset) const {
    const double place = (offset - lines_.first_offset) / lines_.spacing;
    // A line before it: the quotient is rounded, the loop's comparison decides.
    int i = static_cast<int>(std::clamp(std::ceil(place) - 1, -1.0, 1e9));
    while (i < lines_.count && (i < 0 || lines_.OffsetOfLine(i) < offset)) ++i;
    return i;
  }

  ParallelLines lines_;
  SkylineProfile heights_;
};

}  // namespace

ParallelLines LinesAcross(const Dem& dem, const GroundStep& step, double azimuth_deg, int count) {
  const double radians = azimuth_deg * std::numbers::pi / 180;
  // To the right of the direction (sin, cos) of east and north is (cos, -sin).
  const auto to_the_right = [radians](double east, double north) {
    return east * std::cos(radians) - north * std::sin(radians);
  };
  ParallelLines lines;
  lines.azimuth_deg = azimuth_deg;
  lines.offset_a_column = to_the_right(step.column_east_m, step.column_north_m);
  lines.offset_a_row = to_the_right(step.row_east_m, step.row_north_m);
  const double columns = dem.columns - 1;
  const double rows = dem.rows - 1;
  lines.offset_at_origin = -lines.OffsetOf(columns / 2, rows / 2);
  const std::array<double, 4> corners = {lines.OffsetOf(0, 0), lines.OffsetOf(columns, 0),
                                         lines.OffsetOf(0, rows), lines.OffsetOf(columns, rows)};
  const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
  lines.count = count;
  lines.spacing = (*most - *least) / count;
  lines.first_offset = *least + lines.spacing / 2;
  return lines;
}

SkylineProfile ProfileOf(const Dem& dem, const Horizon& horizon, const ParallelLines& lines) {
  Envelope envelope(lines);
  const auto above = [&](VertexId v) {
    return Above{lines.OffsetOf(dem.Column(v), dem.Row(v)), dem.HeightM(v)};
  };
  for (const HorizonEdge& e : horizon.edges) envelope.Add(above(e.edge.a), above(e.edge.b));
  return envelope.Take();
}

SkylineProfile ProfileOf(const GridMesh& mesh, const ParallelLines& lines) {
  Envelope envelope(lines);
  const auto above = [&](std::int32_t i) {
    const GridPoint& p = mesh.points[static_cast<std::size_t>(i)];
    return Above{lines.OffsetOf(p.column, p.row), p.height_m};
  };
  for (const std::array<std::int32_t, 3>& t : mesh.triangles) {
    const std::array<Above, 3> corners = {above(t[0]), above(t[1]), above(t[2])};
    for (std::size_t k = 0; k < 3; ++k) envelope.Add(corners[k], corners[(k + 1) % 3]);
  }
  return envelope.Take();
}

std::string PointOfCompass(int azimuth_deg) {
  constexpr std::array<const char*, 8> kPoints = {"north", "north-east", "east", "south-east",
                                                  "south", "south-west", "west", "north-west"};
  return kPoints[static_cast<std::size_t>(azimuth_deg / 45)];
}

}  // namespace farhorizon
