// Heights go by a ballpark operation never: where a grid is missing, that leaves them as they are,
// tens of metres off.
#include "core/geo/globe_way.h"

#include <numbers>
#include <utility>

#include <proj.h>

#include "core/geo/crs_name.h"
#include "core/geo/height_system.h"
#include "core/geo/parse_crs.h"
#include "core/geo/reference_data.h"

namespace farhorizon {

namespace {

Error NoWayToTheGlobe(const std::string& message, ErrorKind kind) {
  return {ErrorCode::kUnsupportedData, message, kind};
}

// A full turn in the unit of a geographic system's axes; 0 for any other.
double FullTurn(const ProjSession& session, const PJ* plan) {
  const PJ_TYPE type = proj_get_type(plan);
  if (type != PJ_TYPE_GEOGRAPHIC_2D_CRS && type != PJ_TYPE_GEOGRAPHIC_3D_CRS) return 0;
  const ProjObject system(proj_crs_get_coordinate_system(session.get(), plan));
  double unit = 0;
  if (!system || proj_cs_get_axis_info(session.get(), system.get(), 0, nullptr, nullptr, nullptr,
                                       &unit, nullptr, nullptr, nullptr) == 0) {
    return 0;
  }
  return 2 * std::numbers::pi / unit;
}

// `crs` with heights as `vertical_datum` says, or as itself says where that is empty. Heights of
// which no more than the unit is known are none.
Result<ProjObject> WithStatedHeights(ProjSession& session, ProjObject crs,
                                     const std::string& vertical_datum) {
  if (vertical_datum.empty()) {
    const std::optional<HeightAxis> axis = HeightAxisOf(session, crs.get());
    if (!axis) return crs;
    if (!NamesHeightDatum(session, crs.get())) return WithoutHeights(session, std::move(crs));
    const bool vertical = HeightsOf(session, crs.get()) != nullptr;
    if (vertical ? !IsAboveEllipsoid(session, crs.get()) : axis->unit_m == 1) return crs;
    return WithEllipsoidalHeights(session, std::move(crs));
  }
  if (IsEllipsoid(vertical_datum)) return WithoutHeights(session, std::move(crs));
  Result<ProjObject> heights = ReadVerticalSystem(session, vertical_datum);
  if (!heights) return heights;
  return WithHeights(session, std::move(crs), heights->get());
}

constexpr const char* kHeightRemedy =
    "give --vertical-datum EPSG:5773 to take them as above EGM96, or --vertical-datum ellipsoid";

Error NoWay(const ProjSession& session, const GlobeWay& way, const PJ* globe) {
  for (const DatumOperation& one : ListDatumOperations(session, way.crs.get(), globe)) {
    if (one.missing_grids.empty() || one.ballpark_heights) continue;
    return NoWayToTheGlobe("heights in " + way.name + " need the grid " +
                               one.missing_grids.front() + ", which is not installed; " +
                               WhereGridsGo() + ", or " + kHeightRemedy,
                           "no-geoid-grid");
  }
  const std::string why =
      way.height_axis ? std::string(": PROJ knows no more than the name of its vertical datum; ") +
                            kHeightRemedy
                      : "; give another system with --crs";
  return NoWayToTheGlobe("there is no way from " + way.name + " to the globe" + why, "unknown-crs");
}

// Puts EGM96 height in the place of the heights of `way`, which are above some mean sea level.
Status TakeEgm96(ProjSession& session, GlobeWay& way) {
  Result<ProjObject> egm96 = ReadVerticalSystem(session, "EPSG:5773");
  if (!egm96) return std::move(egm96.error());
  Result<ProjObject> above = WithHeights(session, std::move(way.crs), egm96->get());
  if (!above) return std::move(above.error());
  way.crs = *std::move(above);
  way.height_axis = HeightAxisOf(session, way.crs.get());
  way.assumptions.push_back(
      {"vertical-datum", "the mean sea level of " + way.name +
                             " is taken for that of EGM96, some metres from others at most; state "
                             "another with --vertical-datum, or this one with EPSG:5773"});
  return Ok{};
}

}  // namespace

double GlobeWay::HeightUnit() const {
  if (!height_axis) return 1;
  return height_axis->down ? -height_axis->unit_m : height_axis->unit_m;
}

Result<GlobeWay> FindGlobeWay(ProjSession& session, const std::string& crs,
                              const std::string& vertical_datum,
                              const std::string& datum_operation) {
  Result<ProjObject> read = ParseCrs(session, crs);
  if (!read) return std::move(read.error());
  const ProjObject plan = PlanOf(session, read->get());
  if (Status usable = CheckPlan(session, plan.get(), NameOf(session, read->get())); !usable) {
    return std::move(usable.error());
  }
  read = WithStatedHeights(session, std::move(*read), vertical_datum);
  if (!read) return std::move(read.error());
  GlobeWay way{.crs = *std::move(read)};
  way.name = NameOf(session, way.crs.get());
  way.area = AreaOfUseOf(session, plan.get());
  way.full_turn = FullTurn(session, plan.get());
  way.height_axis = HeightAxisOf(session, way.crs.get());
  // A system without heights says nothing of them, whatever its datum: heights stay as they are.
  const ProjObject globe(proj_create(session.get(), way.height_axis ? "EPSG:4979" : "EPSG:4326"));
  if (!globe) {
    return Error{ErrorCode::kIo, "PROJ's database is missing or damaged" + session.Complaint() +
                                     "; install proj-data"};
  }
  Result<DatumChoice> choice =
      TakeDatumOperation(session, way.crs.get(), globe.get(), datum_operation);
  if (choice && choice->all.empty() && IsMeanSeaLevel(session, way.crs.get())) {
    if (Status taken = TakeEgm96(session, way); !taken) return std::move(taken.error());
    choice = TakeDatumOperation(session, way.crs.get(), globe.get(), datum_operation);
  }
  if (!choice) return std::move(choice.error());
  way.choice = *std::move(choice);
  if (way.choice.all.empty()) return NoWay(session, way, globe.get());
  way.to_globe.reset(proj_normalize_for_visualization(session.get(), way.choice.Taken().way.get()));
  if (!way.to_globe) return NoWay(session, way, globe.get());
  return way;
}

}  // namespace farhorizon
