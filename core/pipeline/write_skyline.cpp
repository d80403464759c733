// The skyline of one direction: the horizon edges' lines of sight in that direction, their parts
// put in the viewer's order and measured on the ground. Parts come in the order across the grid,
// which is from left to right or the other way round, as the grid lies on the ground.
#include "core/pipeline/write_skyline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/horizon/find_horizon.h"
#include "core/horizon/lines_of_sight/directional_skyline.h"
#include "core/io/geojson_text.h"
#include "core/io/skyline_features.h"
#include "core/io/skyline_svg.h"
#include "core/pipeline/georeference.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

namespace {

// From points of the grid to the viewer's frame on the ground, whose origin is the DEM's middle.
class ViewFrame {
 public:
  ViewFrame(const ViewDirection& view, const GroundStep& step, std::array<double, 2> middle)
      : step_(step), middle_(middle) {
    const auto [east, north] = step.ToGround(view.dc, view.dr);
    const double length = std::hypot(east, north);
    ahead_ = {east / length, north / length};
  }

  // True where points that are further across the view (Offset) are further to the right.
  [[nodiscard]] bool RisesToTheRight() const { return step_.SignedCellArea() < 0; }
  [[nodiscard]] double Offset(const GridPoint& p) const {
    const auto [east, north] = FromMiddle(p);
    return east * ahead_[1] - north * ahead_[0];
  }
  [[nodiscard]] double Depth(const GridPoint& p) const {
    const auto [east, north] = FromMiddle(p);
    return east * ahead_[0] + north * ahead_[1];
  }

 private:
  [[nodiscard]] std::array<double, 2> FromMiddle(const GridPoint& p) const {
    return step_.ToGround(p.column - middle_[0], p.row - middle_[1]);
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

// The pieces with their left ends at t_from, the leftmost first.
std::vector<SkylinePiece> LeftToRight(std::vector<SkylinePiece> parts, bool rises_to_the_right) {
  if (rises_to_the_right) return parts;
  std::reverse(parts.begin(), parts.end());
  for (SkylinePiece& part : parts) std::swap(part.t_from, part.t_to);
  return parts;
}

Result<SkylineOfDirection> Published(const TerrainInput& input, const Horizon& horizon,
                                     const std::vector<SkylinePiece>& parts,
                                     const ViewFrame& frame) {
  const Dem& dem = input.dem();
  std::vector<GridPoint> ends;
  for (const SkylinePiece& part : parts) {
    ends.push_back(Between(dem, horizon.edges[part.edge].edge, part.t_from));
    ends.push_back(Between(dem, horizon.edges[part.edge].edge, part.t_to));
  }
  Result<std::vector<Geodetic>> points = input.georeference().ToGeodetic(ends);
  if (!points) return std::move(points.error());
  SkylineOfDirection skyline{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Edge edge = horizon.edges[parts[i].edge].edge;
    const GridPoint& left = ends[2 * i];
    const GridPoint& right = ends[2 * i + 1];
    skyline.parts.push_back({{dem.Column(edge.a), dem.Row(edge.a)},
                             {dem.Column(edge.b), dem.Row(edge.b)},
                             (*points)[2 * i],
                             (*points)[2 * i + 1],
                             {parts[i].t_from, parts[i].t_to},
                             {frame.Offset(left), frame.Offset(right)},
                             {frame.Depth(left), frame.Depth(right)}});
  }
  return skyline;
}

// numerator / denominator, in lowest terms.
struct SmallFraction {
  std::int32_t numerator = 0;
  std::int32_t denominator = 1;
};

// The nearest to x of all fractions with denominators up to kMaxViewStep, by continued fractions:
// each convergent is nearer than all fractions of smaller denominators, and past the last one that
// fits the best of those between it and the next may be nearer still. Requires: 0 <= x <= 1.
SmallFraction NearestFraction(double x) {
  SmallFraction before{1, 0};
  SmallFraction last{0, 1};
  const auto error = [x](const SmallFraction& f) {
    return std::abs(x - static_cast<double>(f.numerator) / f.denominator);
  };
  double rest = x;
  double whole = 0;
  // x is rounded itself: nearer than its last place is near enough.
  while (error(last) > 0x1p-53) {
    rest = 1 / (rest - whole);
    whole = std::floor(rest);
    const std::int32_t most = (kMaxViewStep - before.denominator) / last.denominator;
    const bool fits = whole <= most;
    const std::int32_t times = fits ? static_cast<std::int32_t>(whole) : most;
    const SmallFraction next{before.numerator + times * last.numerator,
                             before.denominator + times * last.denominator};
    if (!fits) return next.denominator > 0 && error(next) < error(last) ? next : last;
    before = last;
    last = next;
  }
  return last;
}

// The azimuth of `view`, in the turn of `asked`, to 10^-9 degrees: far less than any DEM's
// georeference is good for, and as a rule what was asked.
double AzimuthOf(const ViewDirection& view, const GroundStep& step, double asked) {
  constexpr double kPerDegree = 1e9;
  const double off = std::remainder(step.ToAzimuth(view.dc, view.dr) - asked, 360);
  return std::round((asked + off) * kPerDegree) / kPerDegree + 0.0;  // no -0
}

Result<SkylineOfDirection> Find(const TerrainInput& input, double azimuth,
                                const BuildOptions& options, const RunControl& control) {
  const Dem& dem = input.dem();
  const std::array<double, 2> middle = {(dem.columns - 1) / 2.0, (dem.rows - 1) / 2.0};
  Result<std::vector<GroundStep>> step = input.georeference().StepsAt({middle});
  if (!step) return std::move(step.error());
  const HorizonOptions horizon_options = HorizonOptionsOf(options);
  WorkBudget budget = WorkBudgetOf(input.terrain(), horizon_options);
  Result<Horizon> horizon = FindHorizon(input.terrain(), horizon_options, budget, control);
  if (!horizon) return std::move(horizon.error());
  Result<std::vector<LinesOfSight>> sights =
      FindLinesOfSight(input.terrain(), *horizon, options.threads, budget, control);
  if (!sights) return std::move(sights.error());
  control.Report(Stage::kWrite, 0);
  const ViewDirection view = DirectionOf(azimuth, step->front());
  const ViewFrame frame(view, step->front(), middle);
  const DirectionalSkylines skylines(input.terrain(), *horizon, *sights);
  Result<SkylineOfDirection> skyline =
      Published(input, *horizon, LeftToRight(skylines.Along(view), frame.RisesToTheRight()), frame);
  if (!skyline) return skyline;
  skyline->azimuth = AzimuthOf(view, step->front(), azimuth);
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

ViewDirection DirectionOf(double azimuth_deg, const GroundStep& step) {
  const auto [columns, rows] = step.ToGrid(azimuth_deg);
  const bool steep = std::abs(rows) > std::abs(columns);
  const double along = steep ? rows : columns;
  const double across = steep ? columns : rows;
  const SmallFraction slope = NearestFraction(std::abs(across / along));
  const std::int32_t longer = std::signbit(along) ? -slope.denominator : slope.denominator;
  const std::int32_t shorter = std::signbit(across) ? -slope.numerator : slope.numerator;
  return steep ? ViewDirection{shorter, longer} : ViewDirection{longer, shorter};
}

Result<std::string> WriteSkyline(const std::filesystem::path& dem, double azimuth,
                                 SkylineFormat format, const BuildOptions& options,
                                 const RunControl& control) {
  if (!(std::abs(azimuth) <= 360)) {
    return Error{ErrorCode::kInvalidArgument,
                 "an azimuth is in degrees clockwise from north, from -360 to 360", "bad-azimuth"};
  }
  control.Report(Stage::kRead, 0);
  Result<std::unique_ptr<TerrainInput>> input = TerrainInput::Open(dem, options, control);
  if (!input) return std::move(input.error());
  control.Report(Stage::kRead, 1);
  Result<SkylineOfDirection> skyline = Find(**input, azimuth, options, control);
  if (!skyline) return std::move(skyline.error());
  std::string text = format == SkylineFormat::kGeoJson
                         ? WriteSkylineGeoJson(*skyline)
                         : DrawSkyline(*skyline, dem.filename().string() + " towards " +
                                                     Rounded(azimuth, 6) + " degrees");
  control.Report(Stage::kWrite, 1);
  return text;
}

}  // namespace farhorizon
