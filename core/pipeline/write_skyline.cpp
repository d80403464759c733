#include "core/pipeline/write_skyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/horizon/find_horizon.h"
#include "core/horizon/lines_of_sight/directional_skyline.h"
#include "core/io/geojson_text.h"
#include "core/io/skyline_features.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {
namespace {

// Places on the ground as the viewer has them, from those in the grid.
class ViewFrame {
 public:
  ViewFrame(const ViewDirection& view, const GroundStep& step, std::array<double, 2> middle)
      : step_(step), middle_(middle) {
    const auto [east, north] = OnGround(view.dc, view.dr);
    const double length = std::hypot(east, north);
    ahead_ = {east / length, north / length};
  }

  // Whether what lies further across the view (Offset) lies to the right.
  [[nodiscard]] bool RisesToTheRight() const {
    return step_.column_east_m * step_.row_north_m < step_.row_east_m * step_.column_north_m;
  }
  [[nodiscard]] double Offset(const GridPoint& p) const {
    const auto [east, north] = FromMiddle(p);
    return east * ahead_[1] - north * ahead_[0];
  }
  [[nodiscard]] double Depth(const GridPoint& p) const {
    const auto [east, north] = FromMiddle(p);
    return east * ahead_[0] + north * ahead_[1];
  }

 private:
  [[nodiscard]] std::array<double, 2> OnGround(double columns, double rows) const {
    return {step_.column_east_m * columns + step_.row_east_m * rows,
            step_.column_north_m * columns + step_.row_north_m * rows};
  }
  [[nodiscard]] std::array<double, 2> FromMiddle(const GridPoint& p) const {
    return OnGround(p.column - middle_[0], p.row - middle_[1]);
  }

  GroundStep step_;
  std::array<double, 2> middle_;
  std::array<double, 2> ahead_{};
};

GridPoint Between(const Dem& dem, Edge edge, double t) {
  const auto mix = [t](double a, double b) { return a + t * (b - a); };
  return {mix(dem.Column(edge.a), dem.Column(edge.b)), mix(dem.Row(edge.a), dem.Row(edge.b)),
          mix(dem.HeightM(edge.a), dem.HeightM(edge.b))};
}

// The parts with their left ends at t_from and the leftmost first.
std::vector<SkylinePiece> LeftToRight(std::vector<SkylinePiece> parts, bool rises_to_the_right) {
  if (rises_to_the_right) return parts;
  std::reverse(parts.begin(), parts.end());
  for (SkylinePiece& part : parts) std::swap(part.t_from, part.t_to);
  return parts;
}

Result<SkylineOfDirection> Published(const TerrainInput& source, const Horizon& horizon,
                                     const std::vector<SkylinePiece>& parts,
                                     const ViewFrame& frame) {
  const Dem& dem = source.dem();
  std::vector<GridPoint> ends;
  for (const SkylinePiece& part : parts) {
    ends.push_back(Between(dem, horizon.edges[part.edge].edge, part.t_from));
    ends.push_back(Between(dem, horizon.edges[part.edge].edge, part.t_to));
  }
  Result<std::vector<Geodetic>> places = source.georeference().ToGeodetic(ends);
  if (!places) return std::move(places.error());
  SkylineOfDirection skyline{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Edge edge = horizon.edges[parts[i].edge].edge;
    const GridPoint& left = ends[2 * i];
    const GridPoint& right = ends[2 * i + 1];
    skyline.parts.push_back({{dem.Column(edge.a), dem.Row(edge.a)},
                             {dem.Column(edge.b), dem.Row(edge.b)},
                             (*places)[2 * i],
                             (*places)[2 * i + 1],
                             {parts[i].t_from, parts[i].t_to},
                             {frame.Offset(left), frame.Offset(right)},
                             {frame.Depth(left), frame.Depth(right)}});
  }
  return skyline;
}

Result<SkylineOfDirection> Find(const TerrainInput& source, double azimuth,
                                const BuildOptions& options, const Watch& watch) {
  const Dem& dem = source.dem();
  const std::array<double, 2> middle = {(dem.columns - 1) / 2.0, (dem.rows - 1) / 2.0};
  Result<std::vector<GroundStep>> step = source.georeference().StepsAt({middle});
  if (!step) return std::move(step.error());
  Result<Horizon> horizon = FindHorizon(source.terrain(),
                                        {.threads = options.threads,
                                         .work_budget = options.work_budget,
                                         .approximate = options.approximate},
                                        watch);
  if (!horizon) return std::move(horizon.error());
  Result<std::vector<LinesOfSight>> sights =
      FindLinesOfSight(source.terrain(), *horizon, options.threads, watch);
  if (!sights) return std::move(sights.error());
  watch.Report(Stage::kWrite, 0);
  const ViewDirection view = DirectionOf(azimuth, step->front());
  const ViewFrame frame(view, step->front(), middle);
  const DirectionalSkylines skylines(source.terrain(), *horizon, *sights);
  Result<SkylineOfDirection> skyline = Published(
      source, *horizon, LeftToRight(skylines.Along(view), frame.RisesToTheRight()), frame);
  if (!skyline) return skyline;
  skyline->azimuth = azimuth;
  skyline->direction = {view.dc, view.dr};
  skyline->approximate = horizon->statistics.undecided > 0;
  return skyline;
}

}  // namespace

Result<SkylineFormat> SkylineFormatOf(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".geojson") return SkylineFormat::kGeoJson;
  if (ending == ".svg") return SkylineFormat::kSvg;
  return Error{ErrorCode::kInvalidArgument,
               "no format of a skyline has the ending \"" + ending + "\"; use .geojson or .svg",
               "unknown-format"};
}

ViewDirection DirectionOf(double azimuth, const GroundStep& step) {
  const double angle = azimuth / 180 * std::numbers::pi;
  const double east = std::sin(angle);
  const double north = std::cos(angle);
  // The inverse of the step, but for the size, and with the sign of its determinant.
  const double sign = std::copysign(
      1.0, step.column_east_m * step.row_north_m - step.row_east_m * step.column_north_m);
  const double columns = sign * (step.row_north_m * east - step.row_east_m * north);
  const double rows = sign * (step.column_east_m * north - step.column_north_m * east);
  const double most = std::max(std::abs(columns), std::abs(rows));
  const auto scaled = [most](double value) {
    return static_cast<std::int32_t>(std::lround(value / most * kMaxViewStep));
  };
  return {scaled(columns), scaled(rows)};
}

Result<std::string> SkylineOfDem(const std::filesystem::path& dem, double azimuth,
                                 SkylineFormat format, const BuildOptions& options,
                                 const Watch& watch) {
  if (!(std::abs(azimuth) <= 360)) {
    return Error{ErrorCode::kInvalidArgument,
                 "an azimuth is in degrees clockwise from north, from -360 to 360", "bad-azimuth"};
  }
  watch.Report(Stage::kRead, 0);
  Result<std::unique_ptr<TerrainInput>> source = TerrainInput::Open(dem, options);
  if (!source) return std::move(source.error());
  watch.Report(Stage::kRead, 1);
  Result<SkylineOfDirection> skyline = Find(**source, azimuth, options, watch);
  if (!skyline) return std::move(skyline.error());
  std::string text = format == SkylineFormat::kGeoJson
                         ? WriteSkylineGeoJson(*skyline)
                         : DrawSkyline(*skyline, dem.filename().string() + " towards " +
                                                     Rounded(azimuth, 6) + " degrees");
  watch.Report(Stage::kWrite, 1);
  return text;
}

}  // namespace farhorizon
