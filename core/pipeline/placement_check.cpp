// What would make a mesh that is wrong, or a message about its vertices, is found here by its
// cause: an extent, a pole, the edge of a map, cells of a millimetre.
#include "core/pipeline/placement_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/io/quantization_lattice.h"

namespace farhorizon {

namespace {

// Rows, and posts of a row, that are looked at; any number is sound, these take milliseconds.
constexpr std::int32_t kSampled = 64;
// A vertex may be half a cell from its post (mesh_error.h). Rounding moves it by half a step on
// each axis, by sqrt(3) / 2 steps in plan at most, for the axes may be any: no cell may be narrower
// than sqrt(3) steps.
constexpr double kLeastSteps = std::numbers::sqrt3;
// Cells of so many steps keep their triangles' turn, too, wherever their corners are rounded to.
constexpr double kSafeSteps = 2;
// The share of a cell by which a post may come back elsewhere. Datum shifts without heights come
// back within a millimetre (globe_transform.h), a tenth of a cell of a centimetre.
constexpr double kMostOff = 0.1;

constexpr const char* kWarp = "gdalwarp -r bilinear -ot Float32 -dstnodata -9999";

std::string Number(double value, const char* format = "%.6g") {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

Error Bad(const std::string& message, ErrorKind kind) {
  return {ErrorCode::kUnsupportedData, message, kind};
}

// Rows first to last, both included.
struct Rows {
  std::int32_t first = 0;
  std::int32_t last = -1;
};

bool HasData(const Dem& dem, std::int32_t row) {
  const auto begin = dem.heights.begin() + std::ptrdiff_t{row} * dem.columns;
  return std::any_of(begin, begin + dem.columns,
                     [](std::int32_t height) { return height != kNoHeight; });
}

// The rows with data; the terrain has some.
Rows RowsWithData(const Dem& dem) {
  Rows rows = {0, dem.rows - 1};
  while (!HasData(dem, rows.first)) ++rows.first;
  while (!HasData(dem, rows.last)) --rows.last;
  return rows;
}

// Posts with data within `rows`, the outermost of each row that is looked at among them.
std::vector<VertexId> SamplePosts(const Dem& dem, const Rows& rows) {
  std::vector<VertexId> posts;
  const std::int32_t row_step = std::max(1, (rows.last - rows.first) / kSampled);
  const std::int32_t column_step = std::max(1, dem.columns / kSampled);
  for (std::int32_t row = rows.first; row <= rows.last;
       row = row == rows.last ? row + 1 : std::min(row + row_step, rows.last)) {
    std::optional<VertexId> last;
    std::int32_t due = 0;
    for (std::int32_t column = 0; column < dem.columns; ++column) {
      const VertexId v = row * dem.columns + column;
      if (!dem.HasData(v)) continue;
      last = v;
      if (!posts.empty() && dem.Row(posts.back()) == row && column < due) continue;
      posts.push_back(v);
      due = column + column_step;
    }
    if (last && posts.back() != *last) posts.push_back(*last);
  }
  return posts;
}

// Degrees that are taken for metres lie within 360 m of a map's origin, which is no place of its
// own in systems with false eastings; one whose area is there is left alone.
Status CheckNoDegrees(const Dem& dem, const Georeference& georeference) {
  const GeoTransform& t = dem.transform;
  const double x = std::max(std::abs(t.origin_x), std::abs(t.origin_x + dem.columns * t.step_x));
  const double y = std::max(std::abs(t.origin_y), std::abs(t.origin_y + dem.rows * t.step_y));
  if (x > 360 || y > 90 || georeference.FullTurn() > 0 || georeference.InAreaOfUse()) return Ok{};
  const Geodetic middle = georeference.middle();
  return Bad("the DEM's middle would be at longitude " + Number(middle.lon_deg) + ", latitude " +
                 Number(middle.lat_deg) + ", outside the area where " + georeference.CrsName() +
                 " is used, and its coordinates look like degrees; is --crs right? Degrees of GPS "
                 "are --crs EPSG:4326",
             "outside-crs");
}

class PlacementCheck {
 public:
  PlacementCheck(const Terrain& terrain, const Georeference& georeference)
      : dem_(terrain.dem()), georeference_(georeference), data_(RowsWithData(dem_)) {}

  Status Run() {
    const Rows placed = RowsOnTheGlobe();
    if (placed.first > placed.last) return BeyondThePole(placed);
    posts_ = SamplePosts(dem_, placed);
    Result<std::vector<Enu>> enu = georeference_.ToEnu(posts_);
    if (!enu) return std::move(enu.error());
    enu_ = *std::move(enu);
    if (Status near = CheckExtent(); !near) return near;
    if (placed.first > data_.first || placed.last < data_.last) return BeyondThePole(placed);
    // Cells without extent get a step, too, and are too narrow for it: PROJ is no truer than this.
    constexpr double kLeastStep = 1e-9;
    step_m_ = ChooseLattice(enu_, std::max(SmallestCell() / 1024, kLeastStep)).step_m;
    if (Status wide = CheckCells(); !wide) return wide;
    return CheckReturn();
  }

 private:
  [[nodiscard]] double LatitudeShare(std::int32_t row) const {
    const double y = dem_.transform.origin_y + row * dem_.transform.step_y;
    return std::abs(y) / (georeference_.FullTurn() / 4);
  }
  [[nodiscard]] double SmallestCell() const {
    return std::min(georeference_.column_step_m(), georeference_.row_step_m());
  }

  // Of the rows with data those that are not beyond a pole.
  [[nodiscard]] Rows RowsOnTheGlobe() const {
    Rows rows = data_;
    if (!(georeference_.FullTurn() > 0)) return rows;
    while (rows.first <= rows.last && LatitudeShare(rows.first) > 1) ++rows.first;
    while (rows.last > rows.first && LatitudeShare(rows.last) > 1) --rows.last;
    return rows;
  }

  // "gdal_translate -srcwin ..." that leaves `rows`.
  [[nodiscard]] std::string CutTo(const Rows& rows) const {
    return "gdal_translate -srcwin 0 " + std::to_string(rows.first) + " " +
           std::to_string(dem_.columns) + " " + std::to_string(rows.last - rows.first + 1) +
           " IN OUT.tif";
  }

  [[nodiscard]] Error BeyondThePole(const Rows& placed) const {
    if (placed.first > placed.last) {
      return Bad("the raster's rows are all beyond 90 degrees of latitude in " +
                     georeference_.CrsName() + "; is --crs right?",
                 "outside-crs");
    }
    return Bad("rows of the raster lie beyond the pole, at latitudes above 90 degrees in " +
                   georeference_.CrsName() + "; cut them off with " + CutTo(placed),
               "outside-crs");
  }

  [[nodiscard]] Status CheckExtent() const {
    const Ecef o = georeference_.frame().ToEcef({0, 0, 0});
    double most = 0;
    for (const Enu& point : enu_) {
      const Ecef p = georeference_.frame().ToEcef(point);
      const double across =
          std::hypot(o.y * p.z - o.z * p.y, o.z * p.x - o.x * p.z, o.x * p.y - o.y * p.x);
      most = std::max(most, std::atan2(across, o.x * p.x + o.y * p.y + o.z * p.z));
    }
    const double degrees = most * 180 / std::numbers::pi;
    if (degrees <= kMostDegreesFromMiddle) return Ok{};
    return Bad("the DEM is too much of the globe for one plane: posts lie " +
                   Number(degrees, "%.1f") + " degrees from its middle, the limit is " +
                   Number(kMostDegreesFromMiddle) +
                   "; cut it into parts with gdal_translate -projwin (if it is not so large, is "
                   "--crs right?)",
               "too-large-extent");
  }

  // The least width of a cell with this ground step: its least altitude.
  static double WidthOf(const GroundStep& step) {
    const double column = std::hypot(step.column_east_m, step.column_north_m);
    const double row = std::hypot(step.row_east_m, step.row_north_m);
    const double longest = std::max(column, row);
    return longest > 0 ? std::abs(step.SignedCellArea()) / longest : 0;
  }

  [[nodiscard]] Status CheckCells() const {
    std::vector<std::array<double, 2>> places;
    for (const VertexId v : posts_) places.push_back(Place(v));
    Result<std::vector<double>> widths = WidthsAt(places);
    if (!widths) return std::move(widths.error());
    const auto least = std::min_element(widths->begin(), widths->end());
    if (*least >= kLeastSteps * step_m_) return Ok{};
    const VertexId v = posts_[static_cast<std::size_t>(least - widths->begin())];
    const std::string what = "cells at column " + std::to_string(dem_.Column(v)) + ", row " +
                             std::to_string(dem_.Row(v)) + " are " + Number(*least, "%.3g") +
                             " m wide on the ground in " + georeference_.CrsName() +
                             ", positions in " + std::to_string(kMaxLatticeBits) +
                             " bits over this DEM are " + Number(step_m_, "%.3g") + " m apart; ";
    if (georeference_.FullTurn() > 0 && LatitudeShare(dem_.Row(v)) > kPolar) {
      return NearThePole(v, what);
    }
    return Bad(what + "is --crs right? If it is, cut the raster into parts, or make it coarser",
               "cells-too-narrow");
  }

  // From 60 degrees of latitude on, columns are less than half as far apart as at the equator.
  static constexpr double kPolar = 2.0 / 3;

  // Meridians meet at the pole: rows near to it have posts that are as good as one.
  [[nodiscard]] Status NearThePole(VertexId narrow, const std::string& what) const {
    const double middle = (dem_.columns - 1) / 2.0;
    std::vector<std::array<double, 2>> places;
    for (std::int32_t row = data_.first; row <= data_.last; ++row) {
      places.push_back({middle, static_cast<double>(row)});
    }
    Result<std::vector<double>> widths = WidthsAt(places);
    if (!widths) return std::move(widths.error());
    const auto wide = [&](std::int32_t row) {
      return (*widths)[static_cast<std::size_t>(row - data_.first)] >= kSafeSteps * step_m_;
    };
    Rows left = data_;
    while (left.first <= left.last && !wide(left.first)) ++left.first;
    while (left.last > left.first && !wide(left.last)) --left.last;
    const double y = dem_.transform.origin_y + dem_.Row(narrow) * dem_.transform.step_y;
    const std::string polar = y > 0 ? "EPSG:3413" : "EPSG:3031";
    const std::string cut = left.last - left.first > 0
                                ? "cut the rows near the pole off with " + CutTo(left) + ", or "
                                : "";
    return Bad(what + "columns meet at the pole; " + cut + "warp it to a polar system with " +
                   kWarp + " -t_srs " + polar + " IN OUT.tif",
               "cells-too-narrow");
  }

  // Widths of cells at `places`, [column, row]. A step looks half a cell to each side: where that
  // is beyond a pole, it looks from half a cell further inside, and at the pole itself cells have
  // none.
  [[nodiscard]] Result<std::vector<double>> WidthsAt(
      const std::vector<std::array<double, 2>>& places) const {
    std::vector<std::array<double, 2>> inside;
    for (auto [column, row] : places) {
      if (georeference_.FullTurn() > 0) {
        const double half = 0.5 * std::abs(dem_.transform.step_y);
        const double y = dem_.transform.origin_y + row * dem_.transform.step_y;
        const double most = georeference_.FullTurn() / 4 - half;
        const double moved = std::clamp(y, -most, most);
        row += (moved - y) / dem_.transform.step_y;
      }
      inside.push_back({column, row});
    }
    Result<std::vector<GroundStep>> steps = georeference_.StepsAt(inside);
    if (!steps) return std::move(steps.error());
    std::vector<double> widths;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool pole = georeference_.FullTurn() > 0 &&
                        LatitudeShare(static_cast<std::int32_t>(places[i][1])) >= 1 - 1e-9;
      widths.push_back(pole ? 0 : WidthOf((*steps)[i]));
    }
    return widths;
  }

  [[nodiscard]] Status CheckReturn() const {
    Result<std::vector<GridPoint>> back = georeference_.ToGrid(enu_);
    if (!back) return std::move(back.error());
    for (std::size_t i = 0; i < posts_.size(); ++i) {
      const auto [column, row] = Place(posts_[i]);
      const GridPoint& p = (*back)[i];
      if (std::hypot(p.column - column, p.row - row) <= kMostOff) continue;
      return Bad("the post at column " + Number(column) + ", row " + Number(row) +
                     " does not come back from the globe to its place in " +
                     georeference_.CrsName() +
                     ": the raster lies outside of what this system can show, or over its edge; "
                     "is --crs right? If it is, cut the raster there with gdal_translate -srcwin",
                 "outside-crs");
    }
    return Ok{};
  }

  [[nodiscard]] std::array<double, 2> Place(VertexId v) const {
    return {static_cast<double>(dem_.Column(v)), static_cast<double>(dem_.Row(v))};
  }

  const Dem& dem_;
  const Georeference& georeference_;
  Rows data_;
  std::vector<VertexId> posts_;
  std::vector<Enu> enu_;
  double step_m_ = 0;
};

}  // namespace

Status CheckPlacement(const Terrain& terrain, const Georeference& georeference) {
  if (Status placed = PlacementCheck(terrain, georeference).Run(); !placed) return placed;
  return CheckNoDegrees(terrain.dem(), georeference);
}

}  // namespace farhorizon
