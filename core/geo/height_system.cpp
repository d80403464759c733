// What the reader asks of a reference system, without a word of PROJ in the header: a session is
// opened, the vertical axis is looked up, and units and direction are handed out as plain values.
#include "core/geo/height_system.h"

#include <cstdio>
#include <memory>
#include <utility>

#include <proj.h>

#include "core/base/lower.h"
#include "core/geo/crs_name.h"
#include "core/geo/parse_crs.h"
#include "core/geo/short_text.h"
#include "core/geo/vertical_system.h"

namespace farhorizon {

namespace {

std::string Metres(double metres) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g m", metres);
  return text;
}

std::optional<HeightSystem> Described(const ProjSession& session, const PJ* crs) {
  const std::optional<HeightAxis> axis = HeightAxisOf(session, crs);
  if (!axis) return std::nullopt;
  const ProjObject heights = HeightsOf(session, crs);
  return HeightSystem{.name = NameOf(session, heights ? heights.get() : crs),
                      .unit = axis->unit,
                      .unit_m = axis->unit_m,
                      .down = axis->down,
                      .names_datum = NamesHeightDatum(session, crs)};
}

}  // namespace

Result<CrsUnits> ReadCrsUnits(const std::string& crs) {
  ProjSession session;
  Result<ProjObject> read = ParseCrs(session, crs);
  if (!read) return std::move(read.error());
  CrsUnits units;
  units.heights = Described(session, read->get());
  const ProjObject plan = PlanOf(session, read->get());
  const ProjObject system(plan ? proj_crs_get_coordinate_system(session.get(), plan.get())
                               : nullptr);
  const char* unit = nullptr;
  double factor = 1;
  if (system && proj_cs_get_axis_info(session.get(), system.get(), 0, nullptr, nullptr, nullptr,
                                      &factor, &unit, nullptr, nullptr) != 0) {
    units.map_unit = unit != nullptr && !IsUnnamed(unit) ? unit : Metres(factor);
    if (proj_get_type(plan.get()) == PJ_TYPE_PROJECTED_CRS) units.map_unit_m = factor;
  }
  return units;
}

Result<std::optional<HeightSystem>> ReadHeightSystem(const std::string& vertical_datum) {
  if (IsEllipsoid(vertical_datum)) return std::optional<HeightSystem>();
  ProjSession session;
  Result<ProjObject> heights = ReadVerticalSystem(session, vertical_datum);
  if (!heights) return std::move(heights.error());
  return Described(session, heights->get());
}

std::optional<LengthUnit> ListedLengthUnit(const std::string& name_or_code) {
  const ProjSession session;
  int count = 0;
  const std::unique_ptr<PROJ_UNIT_INFO*, void (*)(PROJ_UNIT_INFO**)> units(
      proj_get_units_from_database(session.get(), "EPSG", "linear", 0, &count),
      proj_unit_list_destroy);
  const std::string wanted = Lower(name_or_code);
  for (int i = 0; units && i < count; ++i) {
    const PROJ_UNIT_INFO& unit = *units.get()[i];
    if ((Lower(unit.name) == wanted || unit.code == wanted) && unit.conv_factor > 0) {
      return LengthUnit{unit.name, unit.conv_factor};
    }
  }
  return std::nullopt;
}

bool IsEllipsoid(const std::string& vertical_datum) {
  const std::string lower = Lower(CompletedCrsText(vertical_datum));  // without blanks around it
  return lower == "ellipsoid" || lower == "ellipsoidal";
}

}  // namespace farhorizon
