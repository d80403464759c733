// A reference system is read, checked and taken apart with PROJ's C interface: its horizontal part
// must be geographic or projected, its heights may come from a 3-D, a vertical or a bound part.
// Then PROJ looks for a way to WGS 84, and the way that is best at the DEM's middle is kept. PROJ
// prints nothing and fetches nothing; its last message goes into the errors.
#include "core/geo/crs.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <utility>

#include <proj.h>
#include <proj_experimental.h>  // compound systems, demotion to 2-D; GDAL builds on it too

#include "core/geo/crs_text.h"

namespace farhorizon {

namespace {

struct Free {
  void operator()(PJ_CONTEXT* p) const { proj_context_destroy(p); }
  void operator()(PJ* p) const { proj_destroy(p); }
  void operator()(PJ_OBJ_LIST* p) const { proj_list_destroy(p); }
  void operator()(PJ_OPERATION_FACTORY_CONTEXT* p) const {
    proj_operation_factory_context_destroy(p);
  }
};
using ContextPtr = std::unique_ptr<PJ_CONTEXT, Free>;
using PjPtr = std::unique_ptr<PJ, Free>;

// PROJ's context and PROJ's last message, which it would print to stderr otherwise.
struct Session {
  Session() : context(proj_context_create()) {
    proj_context_set_enable_network(context.get(), 0);
    proj_log_level(context.get(), PJ_LOG_ERROR);
    proj_log_func(context.get(), &complaint, [](void* data, int, const char* message) {
      *static_cast<std::string*>(data) = message;
    });
  }
  [[nodiscard]] PJ_CONTEXT* get() const { return context.get(); }
  [[nodiscard]] std::string Complaint() const {
    return complaint.empty() ? "" : " (PROJ: " + complaint + ")";
  }

  std::string complaint;
  ContextPtr context;
};

Error Unusable(const std::string& message, ErrorKind kind) {
  return {ErrorCode::kUnsupportedData, message, kind};
}

// The horizontal part of `crs`; null where it has none.
PjPtr HorizontalPart(const Session& session, const PJ* crs) {
  switch (proj_get_type(crs)) {
    case PJ_TYPE_COMPOUND_CRS: {
      const PjPtr part(proj_crs_get_sub_crs(session.get(), crs, 0));
      return part ? HorizontalPart(session, part.get()) : nullptr;
    }
    case PJ_TYPE_BOUND_CRS: {
      const PjPtr source(proj_get_source_crs(session.get(), crs));
      return source ? HorizontalPart(session, source.get()) : nullptr;
    }
    default:
      return PjPtr(proj_clone(session.get(), crs));
  }
}

struct Axis {
  double unit = 1;  // in metres
  bool down = false;
};

// The axis of heights of `crs`; nullopt where it has none.
std::optional<Axis> HeightAxis(const Session& session, const PJ* crs) {
  switch (proj_get_type(crs)) {
    case PJ_TYPE_COMPOUND_CRS: {
      const PjPtr part(proj_crs_get_sub_crs(session.get(), crs, 1));
      return part ? HeightAxis(session, part.get()) : std::nullopt;
    }
    case PJ_TYPE_BOUND_CRS: {
      const PjPtr source(proj_get_source_crs(session.get(), crs));
      return source ? HeightAxis(session, source.get()) : std::nullopt;
    }
    default:
      break;
  }
  const PjPtr system(proj_crs_get_coordinate_system(session.get(), crs));
  if (!system) return std::nullopt;
  const int count = proj_cs_get_axis_count(session.get(), system.get());
  if (count == 2) return std::nullopt;  // 1: a vertical system; 3: its last
  Axis axis;
  const char* direction = nullptr;
  if (proj_cs_get_axis_info(session.get(), system.get(), count - 1, nullptr, nullptr, &direction,
                            &axis.unit, nullptr, nullptr, nullptr) == 0) {
    return std::nullopt;
  }
  axis.down = direction != nullptr && std::string(direction) == "down";
  return axis;
}

// A full turn in the unit of a geographic system's axes; 0 for any other.
double FullTurn(const Session& session, const PJ* horizontal) {
  const PJ_TYPE type = proj_get_type(horizontal);
  if (type != PJ_TYPE_GEOGRAPHIC_2D_CRS && type != PJ_TYPE_GEOGRAPHIC_3D_CRS) return 0;
  const PjPtr system(proj_crs_get_coordinate_system(session.get(), horizontal));
  double unit = 0;
  if (!system || proj_cs_get_axis_info(session.get(), system.get(), 0, nullptr, nullptr, nullptr,
                                       &unit, nullptr, nullptr, nullptr) == 0) {
    return 0;
  }
  return 2 * std::numbers::pi / unit;
}

std::string CodeOf(const PJ* object) {
  const char* authority = proj_get_id_auth_name(object, 0);
  const char* code = proj_get_id_code(object, 0);
  return authority != nullptr && code != nullptr ? std::string(authority) + ":" + code : "";
}

std::string NameOf(const Session& session, const PJ* crs) {
  if (std::string code = CodeOf(crs); !code.empty()) return code;
  if (proj_get_type(crs) == PJ_TYPE_COMPOUND_CRS) {
    const PjPtr plan(proj_crs_get_sub_crs(session.get(), crs, 0));
    const PjPtr height(proj_crs_get_sub_crs(session.get(), crs, 1));
    const std::string first = plan ? CodeOf(plan.get()) : "";
    const std::string second = height ? CodeOf(height.get()) : "";
    const std::size_t colon = first.find(':');
    if (!first.empty() && !second.empty() &&
        first.substr(0, colon + 1) == second.substr(0, colon + 1)) {
      return first + "+" + second.substr(colon + 1);
    }
  }
  const char* name = proj_get_name(crs);
  return name != nullptr ? name : "";
}

Result<PjPtr> ReadCrs(Session& session, const std::string& text) {
  if (Status allowed = CheckCrsText(text); !allowed) return std::move(allowed.error());
  PjPtr crs(proj_create(session.get(), text.c_str()));
  if (!crs || proj_is_crs(crs.get()) == 0) {
    return Unusable("reference system \"" + text.substr(0, 60) + "\" is not known" +
                        session.Complaint() + "; give a code such as EPSG:4326, or WKT",
                    "unknown-crs");
  }
  return crs;
}

Status CheckPlan(const PJ* horizontal, const std::string& name) {
  const PJ_TYPE type = horizontal != nullptr ? proj_get_type(horizontal) : PJ_TYPE_UNKNOWN;
  switch (type) {
    case PJ_TYPE_GEOGRAPHIC_2D_CRS:
    case PJ_TYPE_GEOGRAPHIC_3D_CRS:
    case PJ_TYPE_PROJECTED_CRS:
      return Ok{};
    case PJ_TYPE_ENGINEERING_CRS:
      return Unusable("reference system \"" + name +
                          "\" is local: nothing says where on Earth it lies; give the true one "
                          "with --crs",
                      "local-crs");
    default:
      return Unusable("reference system \"" + name +
                          "\" is not one of maps (neither geographic nor projected); give "
                          "another with --crs",
                      "unknown-crs");
  }
}

// The horizontal part of `crs` with heights above `datum`, whatever `crs` says of heights.
Result<PjPtr> WithVerticalDatum(Session& session, PjPtr crs, const std::string& datum) {
  const std::string name = NameOf(session, crs.get());
  PjPtr plan(proj_get_type(crs.get()) == PJ_TYPE_COMPOUND_CRS
                 ? proj_crs_get_sub_crs(session.get(), crs.get(), 0)
                 : crs.release());
  if (plan && HeightAxis(session, plan.get())) {
    plan.reset(proj_crs_demote_to_2D(session.get(), nullptr, plan.get()));
  }
  if (!plan) return Unusable("reference system \"" + name + "\" has no plan", "unknown-crs");
  if (datum == "ellipsoid") return plan;
  Result<PjPtr> height = ReadCrs(session, datum);
  if (!height) return std::move(height.error()).WithContext("vertical datum");
  if (proj_get_type(height->get()) != PJ_TYPE_VERTICAL_CRS) {
    return Unusable("vertical datum \"" + datum +
                        "\" is no vertical reference system; give one such as EPSG:5773 (EGM96 "
                        "height), or \"ellipsoid\"",
                    "unknown-crs");
  }
  PjPtr both(proj_create_compound_crs(session.get(), nullptr, plan.get(), height->get()));
  if (!both) {
    return Unusable(
        "vertical datum \"" + datum + "\" does not go with " + name + session.Complaint(),
        "unknown-crs");
  }
  return both;
}

// The first grid that a way from `source` to `target` needs and this machine lacks.
std::string MissingGrid(const Session& session, const PJ* source, const PJ* target) {
  const std::unique_ptr<PJ_OPERATION_FACTORY_CONTEXT, Free> factory(
      proj_create_operation_factory_context(session.get(), nullptr));
  proj_operation_factory_context_set_grid_availability_use(session.get(), factory.get(),
                                                           PROJ_GRID_AVAILABILITY_IGNORED);
  proj_operation_factory_context_set_spatial_criterion(session.get(), factory.get(),
                                                       PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
  proj_operation_factory_context_set_allow_ballpark_transformations(session.get(), factory.get(),
                                                                    0);
  const std::unique_ptr<PJ_OBJ_LIST, Free> ways(
      proj_create_operations(session.get(), source, target, factory.get()));
  for (int i = 0; ways && i < proj_list_get_count(ways.get()); ++i) {
    const PjPtr way(proj_list_get(session.get(), ways.get(), i));
    const int grids = proj_coordoperation_get_grid_used_count(session.get(), way.get());
    for (int j = 0; j < grids; ++j) {
      const char* name = nullptr;
      int available = 1;
      if (proj_coordoperation_get_grid_used(session.get(), way.get(), j, &name, nullptr, nullptr,
                                            nullptr, nullptr, nullptr, &available) != 0 &&
          available == 0 && name != nullptr) {
        return name;
      }
    }
  }
  return "";
}

}  // namespace

struct GlobeTransform::State {
  Session session;
  PjPtr crs;
  PjPtr to_globe;  // normalised: x east, y north; degrees on the globe
  PjPtr to_ecef;   // from degrees
  std::optional<Axis> height_axis;
  std::string name;
  double full_turn = 0;
  std::optional<double> about_x;
  Assumptions assumptions;

  // A system without heights says nothing of them, whatever its datum: heights stay as they are.
  [[nodiscard]] bool HasHeights() const { return height_axis.has_value(); }
  [[nodiscard]] double HeightUnit() const { return height_axis ? height_axis->unit : 1; }

  Status FindWay();
  Status FixWayAt(const MapPoint& about);
};

// Finds PROJ's way from `crs` to the globe. Not by a ballpark operation where there are heights:
// where a grid is missing, that leaves them as they are, tens of metres off.
Status GlobeTransform::State::FindWay() {
  const PjPtr globe(proj_create(session.get(), HasHeights() ? "EPSG:4979" : "EPSG:4326"));
  if (!globe) {
    return Error{ErrorCode::kIo, "PROJ's database is missing or damaged" + session.Complaint() +
                                     "; install proj-data"};
  }
  const char* options[] = {HasHeights() ? "ALLOW_BALLPARK=NO" : nullptr, nullptr};
  const PjPtr way(
      proj_create_crs_to_crs_from_pj(session.get(), crs.get(), globe.get(), nullptr, options));
  if (way) to_globe.reset(proj_normalize_for_visualization(session.get(), way.get()));
  if (!to_globe) {
    if (const std::string grid = MissingGrid(session, crs.get(), globe.get()); !grid.empty()) {
      return Unusable("heights in " + name + " need the grid " + grid +
                          ", which is not installed; install it where PROJ looks for grids, or "
                          "give --vertical-datum",
                      "no-geoid-grid");
    }
    return Unusable("there is no way from " + name + " to the globe" + session.Complaint(),
                    "unknown-crs");
  }
  to_ecef.reset(proj_create(session.get(),
                            "+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad "
                            "+step +proj=cart +ellps=WGS84"));
  Check(to_ecef != nullptr, "PROJ has no geocentric conversion");
  return Ok{};
}

// Keeps the operation that PROJ uses at `about` for all points.
Status GlobeTransform::State::FixWayAt(const MapPoint& about) {
  about_x = about.x;
  const PJ_COORD there =
      proj_trans(to_globe.get(), PJ_FWD, proj_coord(about.x, about.y, about.z / HeightUnit(), 0));
  if (!std::isfinite(there.xyz.x) || !std::isfinite(there.xyz.y)) {
    char place[80];
    std::snprintf(place, sizeof place, "(%.9g, %.9g)", about.x, about.y);
    return Unusable("the DEM's point " + std::string(place) + " has no place on the globe in " +
                        name + session.Complaint() + "; is --crs right?",
                    "outside-crs");
  }
  if (PJ* used = proj_trans_get_last_used_operation(to_globe.get()); used != nullptr) {
    to_globe.reset(used);
  }
  return Ok{};
}

GlobeTransform::GlobeTransform(std::unique_ptr<State> state) : state_(std::move(state)) {}
GlobeTransform::~GlobeTransform() = default;
GlobeTransform::GlobeTransform(GlobeTransform&&) noexcept = default;
GlobeTransform& GlobeTransform::operator=(GlobeTransform&&) noexcept = default;

Result<GlobeTransform> GlobeTransform::Open(const std::string& crs,
                                            const std::string& vertical_datum,
                                            std::optional<MapPoint> about) {
  auto state = std::make_unique<State>();
  Session& session = state->session;
  Result<PjPtr> read = ReadCrs(session, crs);
  if (!read) return std::move(read.error());
  const PjPtr plan = HorizontalPart(session, read->get());
  if (Status usable = CheckPlan(plan.get(), NameOf(session, read->get())); !usable) {
    return std::move(usable.error());
  }
  if (!vertical_datum.empty()) {
    read = WithVerticalDatum(session, std::move(*read), vertical_datum);
    if (!read) return std::move(read.error());
  }
  state->crs = std::move(*read);
  state->name = NameOf(session, state->crs.get());
  state->full_turn = FullTurn(session, plan.get());
  state->height_axis = HeightAxis(session, state->crs.get());
  if (state->height_axis && state->height_axis->down) {
    return Unusable("reference system " + state->name +
                        " counts depths downwards, heights are wanted; give --vertical-datum",
                    "unknown-crs");
  }
  if (Status found = state->FindWay(); !found) return std::move(found.error());
  if (about) {
    if (Status fixed = state->FixWayAt(*about); !fixed) return std::move(fixed.error());
  }
  return GlobeTransform(std::move(state));
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
  return Unusable(point + what, "outside-crs");
}

}  // namespace

Result<std::vector<Geodetic>> GlobeTransform::ToGeodetic(
    const std::vector<MapPoint>& points) const {
  std::vector<Geodetic> result;
  result.reserve(points.size());
  const double unit = state_->HeightUnit();
  for (const MapPoint& p : points) result.push_back({p.x, p.y, p.z / unit});
  Transform(state_->to_globe.get(), PJ_FWD, result,
            {&Geodetic::lon_deg, &Geodetic::lat_deg, &Geodetic::height_m}, state_->HasHeights());
  for (std::size_t i = 0; i < result.size(); ++i) {
    Geodetic& g = result[i];
    // Where PROJ has nothing to compute, it lets latitudes beyond a pole pass.
    if (!std::isfinite(g.lon_deg) || !std::isfinite(g.height_m) || !(std::abs(g.lat_deg) <= 90)) {
      return Outside(i, points[i].x, points[i].y,
                     " has no place on the globe in " + state_->name + "; is --crs right?");
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
  Transform(state_->to_globe.get(), PJ_INV, result, {&MapPoint::x, &MapPoint::y, &MapPoint::z},
            state_->HasHeights());
  const double unit = state_->HeightUnit();
  for (std::size_t i = 0; i < result.size(); ++i) {
    MapPoint& p = result[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return Outside(i, points[i].lon_deg, points[i].lat_deg,
                     " on the globe has no place in " + state_->name);
    }
    p.z *= unit;
    if (state_->full_turn > 0 && state_->about_x) {
      p.x += state_->full_turn * std::round((*state_->about_x - p.x) / state_->full_turn);
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

std::string GlobeTransform::Name() const { return state_->name; }

const Assumptions& GlobeTransform::assumptions() const { return state_->assumptions; }

}  // namespace farhorizon
