// A skyline over a row of parallel lines: each segment raises the lines that it crosses. The DEM's
// horizon edges have its skyline (core/horizon/README.md, theorem 2); of a mesh all edges count.
#include "core/pipeline/compare/compare_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace farhorizon {

namespace {

constexpr std::size_t kLines = 1200;  // one a pixel, about
constexpr std::int32_t kMapCells = 180;
constexpr double kRadians = 3.14159265358979323846 / 180;

// Offsets of points of the grid to the right of a line of sight through its middle, metres.
class Across {
 public:
  Across(const GroundStep& step, const Dem& dem, double azimuth_deg)
      : step_(step),
        middle_{(dem.columns - 1) / 2.0, (dem.rows - 1) / 2.0},
        right_{std::cos(azimuth_deg * kRadians), -std::sin(azimuth_deg * kRadians)} {}

  [[nodiscard]] double Of(double column, double row) const {
    const auto [east, north] = step_.ToGround(column - middle_[0], row - middle_[1]);
    return east * right_[0] + north * right_[1];
  }

 private:
  GroundStep step_;
  std::array<double, 2> middle_;
  std::array<double, 2> right_;
};

// Greatest heights over lines at regular offsets.
class Skyline {
 public:
  // Lines in the middles of equal parts: the outermost graze no outline.
  Skyline(double from, double to)
      : from_(from + (to - from) / kLines / 2),
        step_((to - from) / kLines),
        heights_(kLines, -std::numeric_limits<double>::infinity()) {}

  void Add(std::array<double, 2> a, std::array<double, 2> b) {  // offset, height
    if (a[0] > b[0]) std::swap(a, b);
    const double first = std::clamp(std::ceil((a[0] - from_) / step_), 0.0, double{kLines});
    const double last = std::clamp(std::floor((b[0] - from_) / step_), -1.0, kLines - 1.0);
    for (auto i = static_cast<std::int64_t>(first); i <= static_cast<std::int64_t>(last); ++i) {
      const double at = from_ + static_cast<double>(i) * step_;
      const double share = b[0] > a[0] ? (at - a[0]) / (b[0] - a[0]) : 0;
      double& highest = heights_[static_cast<std::size_t>(i)];
      highest =
          std::max(highest, b[0] > a[0] ? a[1] + share * (b[1] - a[1]) : std::max(a[1], b[1]));
    }
  }

  // NaN where nothing is.
  [[nodiscard]] std::vector<double> Take() && {
    for (double& h : heights_) {
      if (!std::isfinite(h)) h = std::numeric_limits<double>::quiet_NaN();
    }
    return std::move(heights_);
  }
  [[nodiscard]] std::vector<double> Offsets() const {
    std::vector<double> offsets;
    for (std::size_t i = 0; i < kLines; ++i) {
      offsets.push_back(from_ + static_cast<double>(i) * step_);
    }
    return offsets;
  }

 private:
  double from_;
  double step_;
  std::vector<double> heights_;
};

SkylinePair PairOf(const Across& across, double azimuth_deg, const Terrain& terrain,
                   const Horizon& horizon, const GridMesh& mesh) {
  const Dem& dem = terrain.dem();
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (const double column : {0.0, dem.columns - 1.0}) {
    for (const double row : {0.0, dem.rows - 1.0}) {
      from = std::min(from, across.Of(column, row));
      to = std::max(to, across.Of(column, row));
    }
  }
  Skyline of_dem(from, to);
  Skyline of_mesh(from, to);
  const auto post = [&](VertexId v) -> std::array<double, 2> {
    return {across.Of(dem.Column(v), dem.Row(v)), dem.HeightM(v)};
  };
  for (const HorizonEdge& edge : horizon.edges) of_dem.Add(post(edge.edge.a), post(edge.edge.b));
  const auto point = [&](std::int32_t i) -> std::array<double, 2> {
    const GridPoint& p = mesh.points[static_cast<std::size_t>(i)];
    return {across.Of(p.column, p.row), p.height_m};
  };
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) of_mesh.Add(point(t[k]), point(t[(k + 1) % 3]));
  }
  SkylinePair pair{azimuth_deg, of_dem.Offsets(), {}, {}};
  pair.dem_m = std::move(of_dem).Take();
  pair.mesh_m = std::move(of_mesh).Take();
  return pair;
}

}  // namespace

Result<std::vector<SkylinePair>> SkylinePairs(const TerrainInput& input, const Terrain& terrain,
                                              const Horizon& horizon, const GridMesh& mesh) {
  const Dem& whole = input.dem();
  Result<std::vector<GroundStep>> steps =
      input.georeference().StepsAt({{(whole.columns - 1) / 2.0, (whole.rows - 1) / 2.0}});
  if (!steps) return std::move(steps.error());
  std::vector<SkylinePair> pairs;
  for (const double azimuth : {0.0, 45.0, 90.0, 135.0}) {
    pairs.push_back(
        PairOf(Across(steps->front(), terrain.dem(), azimuth), azimuth, terrain, horizon, mesh));
  }
  return pairs;
}

ErrorMap MapOf(const std::vector<double>& errors_m, const Dem& dem, double aspect) {
  ErrorMap map;
  const std::int32_t together = (std::max(dem.columns, dem.rows) + kMapCells - 1) / kMapCells;
  map.columns = (dem.columns + together - 1) / together;
  map.rows = (dem.rows + together - 1) / together;
  map.aspect = aspect;
  map.errors_m.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows),
                      std::numeric_limits<double>::quiet_NaN());
  for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
    const double error = errors_m[static_cast<std::size_t>(v)];
    if (std::isnan(error)) continue;
    const std::int32_t cell = dem.Row(v) / together * map.columns + dem.Column(v) / together;
    double& known = map.errors_m[static_cast<std::size_t>(cell)];
    if (std::isnan(known) || std::abs(error) > std::abs(known)) known = error;
  }
  return map;
}

}  // namespace farhorizon
