// Points go through the one operation of a GlobeWay; to earth-fixed axes and back by PROJ's own
// conversion.
#include "core/geo/globe_transform.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include <proj.h>

#include "core/geo/datum_assumption.h"
#include "core/geo/globe_way.h"

namespace farhorizon {

namespace {

// Surveys go on a little beyond the area of their system: UTM zones are used by the next one's
// neighbours. A place further off than half the area's size is one of another system.
constexpr double kBeyondArea = 0.5;

void AssumeSystem(GlobeWay& way, const std::optional<Geodetic>& middle) {
  if (!middle || !way.area) return;
  if (way.area->Widened(kBeyondArea).Contains(middle->lon_deg, middle->lat_deg)) return;
  char place[80];
  std::snprintf(place, sizeof place, "longitude %.4f, latitude %.4f", middle->lon_deg,
                middle->lat_deg);
  way.assumptions.push_back(
      {"outside-area", "the DEM's middle is taken to lie at " + std::string(place) + ", far from " +
                           way.area->ShortName() + ", where " + way.name +
                           " is used; if it does not, name the right system with --crs"});
}

}  // namespace

struct GlobeTransform::State {
  ProjSession session;
  GlobeWay way;
  ProjObject to_ecef;  // from degrees
  std::optional<double> about_x;

  // The operation is named, too: one by a grid ends where the grid does.
  [[nodiscard]] std::string NotInSystem() const {
    const DatumOperation& taken = way.choice.Taken();
    const std::string nowhere = " has no place on the globe in " + way.name;
    if (taken.names.empty()) return nowhere + "; is --crs right?";
    return nowhere + " by the datum operation " + taken.Described() +
           "; is --crs right, and is the DEM where that holds? --datum-operation states another";
  }
};

GlobeTransform::GlobeTransform(std::unique_ptr<State> state) : state_(std::move(state)) {}
GlobeTransform::~GlobeTransform() = default;
GlobeTransform::GlobeTransform(GlobeTransform&&) noexcept = default;
GlobeTransform& GlobeTransform::operator=(GlobeTransform&&) noexcept = default;

Result<GlobeTransform> GlobeTransform::Open(const std::string& crs, const GlobeOptions& options) {
  auto state = std::make_unique<State>();
  Result<GlobeWay> way =
      FindGlobeWay(state->session, crs, options.vertical_datum, options.datum_operation);
  if (!way) return std::move(way.error());
  state->way = *std::move(way);
  state->to_ecef.reset(proj_create(state->session.get(),
                                   "+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad "
                                   "+step +proj=cart +ellps=WGS84"));
  Check(state->to_ecef != nullptr, "PROJ has no geocentric conversion");
  GlobeTransform transform(std::move(state));
  std::optional<Geodetic> middle;
  if (options.about) {
    Result<std::vector<Geodetic>> there = transform.ToGeodetic({*options.about});
    if (!there) return std::move(there.error());
    middle = there->front();
    transform.state_->about_x = options.about->x;
  }
  GlobeWay& found = transform.state_->way;
  AssumeSystem(found, middle);
  if (std::optional<Assumption> open =
          DatumAssumption(found.choice, found.name, middle, !options.datum_operation.empty())) {
    found.assumptions.push_back(*std::move(open));
  }
  return transform;
}

namespace {

// Transforms points in place. xyz: the members of T that PROJ reads and writes; z only `with_z`.
template <typename T>
void Transform(PJ* way, PJ_DIRECTION direction, std::vector<T>& points,
               const std::array<double T::*, 3>& xyz, bool with_z) {
  if (points.empty()) return;
  const std::size_t n = points.size();
  T& first = points.front();
  const auto [x, y, z] = xyz;
  proj_errno_reset(way);
  proj_trans_generic(way, direction, &(first.*x), sizeof(T), n, &(first.*y), sizeof(T), n,
                     with_z ? &(first.*z) : nullptr, with_z ? sizeof(T) : 0, with_z ? n : 0,
                     nullptr, 0, 0);
}

Error Outside(std::size_t index, double x, double y, const std::string& what) {
  char point[80];
  std::snprintf(point, sizeof point, "point %zu (%.9g, %.9g)", index, x, y);
  return {ErrorCode::kUnsupportedData, point + what, "outside-crs"};
}

}  // namespace

Result<std::vector<Geodetic>> GlobeTransform::ToGeodetic(
    const std::vector<MapPoint>& points) const {
  std::vector<Geodetic> result;
  result.reserve(points.size());
  const double unit = state_->way.HeightUnit();
  for (const MapPoint& p : points) result.push_back({p.x, p.y, p.z / unit});
  Transform(state_->way.to_globe.get(), PJ_FWD, result,
            {&Geodetic::lon_deg, &Geodetic::lat_deg, &Geodetic::height_m},
            state_->way.height_axis.has_value());
  for (std::size_t i = 0; i < result.size(); ++i) {
    Geodetic& g = result[i];
    // Where PROJ has nothing to compute, it lets latitudes beyond a pole pass.
    if (!std::isfinite(g.lon_deg) || !std::isfinite(g.height_m) || !(std::abs(g.lat_deg) <= 90)) {
      return Outside(i, points[i].x, points[i].y, state_->NotInSystem());
    }
    if (std::abs(g.lon_deg) > 180) g.lon_deg = std::remainder(g.lon_deg, 360);
  }
  return result;
}

Result<std::vector<MapPoint>> GlobeTransform::FromGeodetic(
    const std::vector<Geodetic>& points) const {
  std::vector<MapPoint> result;
  result.reserve(points.size());
  for (const Geodetic& g : points) result.push_back({g.lon_deg, g.lat_deg, g.height_m});
  Transform(state_->way.to_globe.get(), PJ_INV, result, {&MapPoint::x, &MapPoint::y, &MapPoint::z},
            state_->way.height_axis.has_value());
  const double unit = state_->way.HeightUnit();
  for (std::size_t i = 0; i < result.size(); ++i) {
    MapPoint& p = result[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return Outside(i, points[i].lon_deg, points[i].lat_deg,
                     " on the globe has no place in " + state_->way.name);
    }
    p.z *= unit;
    if (state_->way.full_turn > 0 && state_->about_x) {
      p.x += state_->way.full_turn * std::round((*state_->about_x - p.x) / state_->way.full_turn);
    }
  }
  return result;
}

Result<std::vector<Ecef>> GlobeTransform::ToEcef(const std::vector<Geodetic>& points) const {
  std::vector<Ecef> result;
  result.reserve(points.size());
  for (const Geodetic& g : points) result.push_back({g.lon_deg, g.lat_deg, g.height_m});
  Transform(state_->to_ecef.get(), PJ_FWD, result, {&Ecef::x, &Ecef::y, &Ecef::z}, true);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!std::isfinite(result[i].x + result[i].y + result[i].z)) {
      return Outside(i, points[i].lon_deg, points[i].lat_deg, " is no place on the globe");
    }
  }
  return result;
}

Result<std::vector<Geodetic>> GlobeTransform::FromEcef(const std::vector<Ecef>& points) const {
  std::vector<Geodetic> result;
  result.reserve(points.size());
  for (const Ecef& p : points) result.push_back({p.x, p.y, p.z});
  Transform(state_->to_ecef.get(), PJ_INV, result,
            {&Geodetic::lon_deg, &Geodetic::lat_deg, &Geodetic::height_m}, true);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Geodetic& g = result[i];
    if (!std::isfinite(g.lon_deg) || !std::isfinite(g.lat_deg) || !std::isfinite(g.height_m)) {
      return Outside(i, points[i].x, points[i].y, " in earth-fixed axes is no place on the globe");
    }
  }
  return result;
}

std::string GlobeTransform::Name() const { return state_->way.name; }

double GlobeTransform::FullTurn() const { return state_->way.full_turn; }

bool GlobeTransform::InAreaOfUse(const Geodetic& place) const {
  const std::optional<AreaOfUse>& area = state_->way.area;
  return !area || area->Contains(place.lon_deg, place.lat_deg);
}

const Assumptions& GlobeTransform::assumptions() const { return state_->way.assumptions; }

}  // namespace farhorizon
