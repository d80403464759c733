#include "core/geo/area_of_use.h"

#include <algorithm>

#include <proj.h>

#include "core/geo/crs_name.h"
#include "core/geo/short_text.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMaxNameBytes = 70;  // of a name in a sentence
constexpr double kWorldTolerance = 1e-6;   // degrees: EPSG's boxes of the world are exact

std::optional<AreaOfUse> StatedArea(const ProjSession& session, const PJ* object) {
  AreaOfUse area;
  const char* name = nullptr;
  if (proj_get_area_of_use(session.get(), object, &area.west, &area.south, &area.east, &area.north,
                           &name) == 0 ||
      area.west < -360 || area.south < -90) {  // -1000: no box, PROJ's documentation
    return std::nullopt;
  }
  if (name != nullptr) area.name = name;
  return area;
}

}  // namespace

bool AreaOfUse::Contains(double lon_deg, double lat_deg) const {
  const bool between =
      west <= east ? lon_deg >= west && lon_deg <= east : lon_deg >= west || lon_deg <= east;
  return between && lat_deg >= south && lat_deg <= north;
}

bool AreaOfUse::IsWorld() const {
  return west <= -180 + kWorldTolerance && east >= 180 - kWorldTolerance &&
         south <= -90 + kWorldTolerance && north >= 90 - kWorldTolerance;
}

AreaOfUse AreaOfUse::Widened(double share) const {
  AreaOfUse wide = *this;
  const double width = west <= east ? east - west : east + 360 - west;
  const double margin = share * width;
  if (width + 2 * margin >= 360) {
    wide.west = -180;
    wide.east = 180;
  } else {
    wide.west = west - margin < -180 ? west - margin + 360 : west - margin;
    wide.east = east + margin > 180 ? east + margin - 360 : east + margin;
  }
  wide.south = std::max(-90.0, south - share * (north - south));
  wide.north = std::min(90.0, north + share * (north - south));
  return wide;
}

std::string AreaOfUse::ShortName() const {
  return ShortText(name.ends_with('.') ? name.substr(0, name.size() - 1) : name, kMaxNameBytes);
}

std::optional<AreaOfUse> AreaOfUseOf(const ProjSession& session, const PJ* object) {
  if (std::optional<AreaOfUse> area = StatedArea(session, object)) return area;
  if (proj_is_crs(object) == 0) return std::nullopt;
  const ProjObject known = Identified(session, object);
  return known ? StatedArea(session, known.get()) : std::nullopt;
}

}  // namespace farhorizon
