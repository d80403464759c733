// From a text to a system that can be placed: completed, checked, read by PROJ, then judged by its
// type. Engineering systems and those of other bodies have no place on Earth, which the error says.
#include "core/geo/parse_crs.h"

#include <utility>

#include <proj.h>

namespace farhorizon {

namespace {

// Ellipsoids of the Earth have semi-major axes of 6,370,997 to 6,378,388 m (spheres and early
// surveys included); the body that comes next in size, Venus, has a radius of 6,051,800 m.
constexpr double kLeastEarthM = 6300000;
constexpr double kGreatestEarthM = 6450000;

Error UnusableCrs(const std::string& message, ErrorKind kind) {
  return {ErrorCode::kUnsupportedData, message, kind};
}

}  // namespace

Result<ProjObject> ParseCrs(ProjSession& session, const std::string& text, CrsRole role) {
  const std::string complete = CompletedCrsText(text);
  if (Status allowed = CheckCrsText(complete, role); !allowed) return std::move(allowed.error());
  ProjObject crs(proj_create(session.get(), complete.c_str()));
  if (!crs || proj_is_crs(crs.get()) == 0) {
    return UnusableCrs(
        ShownCrsText(text, role) + " is not known" + session.Complaint() + "; " + RemedyFor(role),
        "unknown-crs");
  }
  return crs;
}

ProjObject PlanOf(const ProjSession& session, const PJ* crs) {
  ProjObject part(proj_clone(session.get(), crs));
  // A compound system's horizontal part may be bound, and a bound system's source compound.
  for (int depth = 0; part && depth < 4; ++depth) {
    switch (proj_get_type(part.get())) {
      case PJ_TYPE_COMPOUND_CRS:
        part.reset(proj_crs_get_sub_crs(session.get(), part.get(), 0));
        break;
      case PJ_TYPE_BOUND_CRS:
        part.reset(proj_get_source_crs(session.get(), part.get()));
        break;
      default:
        return part;
    }
  }
  return part;
}

Status CheckPlan(const ProjSession& session, const PJ* plan, const std::string& name) {
  const std::string system = "reference system \"" + name + "\" ";
  switch (plan != nullptr ? proj_get_type(plan) : PJ_TYPE_UNKNOWN) {
    case PJ_TYPE_GEOGRAPHIC_2D_CRS:
    case PJ_TYPE_GEOGRAPHIC_3D_CRS:
    case PJ_TYPE_PROJECTED_CRS:
      break;
    case PJ_TYPE_ENGINEERING_CRS:
      return UnusableCrs(system +
                             "is local: nothing says where on Earth it lies; give the true one "
                             "with --crs",
                         "local-crs");
    case PJ_TYPE_VERTICAL_CRS:
      return UnusableCrs(
          system +
              "is one of heights alone; give it with --vertical-datum, and that of the "
              "map with --crs",
          "unknown-crs");
    case PJ_TYPE_GEOCENTRIC_CRS:
      return UnusableCrs(
          system +
              "is geocentric, a grid of heights lies in a map; give the system of the "
              "map with --crs",
          "unknown-crs");
    default:
      return UnusableCrs(system +
                             "is not one of maps (neither geographic nor projected); give another "
                             "with --crs",
                         "unknown-crs");
  }
  const ProjObject ellipsoid(proj_get_ellipsoid(session.get(), plan));
  double axis_m = 0;
  if (ellipsoid &&
      proj_ellipsoid_get_parameters(session.get(), ellipsoid.get(), &axis_m, nullptr, nullptr,
                                    nullptr) != 0 &&
      (axis_m < kLeastEarthM || axis_m > kGreatestEarthM)) {
    return UnusableCrs(system + "is not one of the Earth: its ellipsoid has a semi-major axis of " +
                           std::to_string(static_cast<long long>(axis_m)) +
                           " m; give a system of the Earth with --crs",
                       "unknown-crs");
  }
  return Ok{};
}

}  // namespace farhorizon
