// What a band's raw values mean: metres upwards, by scale, offset, unit and direction.
#include "core/io/dem/values/value_scale.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <gdal.h>

#include "core/geo/height_system.h"
#include "core/io/dem/band_values.h"
#include "core/io/dem/read_dem.h"
#include "core/io/dem/values/height_unit.h"

namespace farhorizon {

namespace {

// The vertical systems that the file and the call name.
struct Systems {
  std::optional<HeightSystem> file;
  std::optional<HeightSystem> call;
  std::string call_flag;     // the option that names the call's
  bool names_datum = false;  // something says above what the heights are
  std::string map_unit;      // of the horizontal axes, where that is no metre
};

Result<Systems> ReadSystems(const std::optional<std::string>& file_crs,
                            const DemReadOptions& options) {
  Systems systems;
  CrsUnits file;
  if (file_crs) {
    Result<CrsUnits> units = ReadCrsUnits(*file_crs);
    if (!units && !options.crs) return std::move(units.error());
    if (units) file = *std::move(units);
  }
  systems.file = file.heights;
  CrsUnits map = file;
  if (options.crs) {
    Result<CrsUnits> units = ReadCrsUnits(*options.crs);
    if (!units) return std::move(units.error());
    map = *std::move(units);
    if (map.heights) {
      systems.call = map.heights;
      systems.call_flag = "--crs";
    }
  }
  systems.names_datum = map.heights && map.heights->names_datum;
  if (options.vertical_datum && !options.vertical_datum->empty()) {
    Result<std::optional<HeightSystem>> heights = ReadHeightSystem(*options.vertical_datum);
    if (!heights) return std::move(heights.error());
    systems.names_datum = true;
    if (*heights) {
      systems.call = *std::move(heights);
      systems.call_flag = "--vertical-datum";
    }
  }
  if (map.map_unit_m && *map.map_unit_m != 1) systems.map_unit = map.map_unit;
  return systems;
}

std::optional<HeightUnit> UnitOf(const std::optional<HeightSystem>& system,
                                 const std::string& source) {
  if (!system || !(system->unit_m > 0) || !std::isfinite(system->unit_m)) return std::nullopt;
  return HeightUnit{.name = system->unit,
                    .metres = system->unit_m,
                    .source = system->names_datum ? system->name + " of " + source : source};
}

// GDAL reads this key only where the file names no vertical system.
std::optional<HeightUnit> UnitOfKey(TiffFile* tiff) {
  constexpr int kVerticalUnitsGeoKey = 4099;  // OGC 19-008r4, 7.5.1
  const std::optional<int> code =
      tiff != nullptr ? tiff->GeoKey(kVerticalUnitsGeoKey) : std::nullopt;
  const std::optional<LengthUnit> unit =
      code ? ListedLengthUnit(std::to_string(*code)) : std::nullopt;
  if (!unit) return std::nullopt;
  return HeightUnit{
      .name = unit->name, .metres = unit->metres, .source = "the file's VerticalUnitsGeoKey"};
}

// GDAL makes the band's unit of the vertical system's where the band has none of its own.
Result<HeightUnit> DecideUnit(OpenedDem& dem, const Systems& systems) {
  const DemReadOptions& options = dem.options;
  HeightUnitSources sources{.call_system = UnitOf(systems.call, systems.call_flag),
                            .file_key = UnitOfKey(dem.Tiff()),
                            .file_system = UnitOf(systems.file, "the file"),
                            .map_unit = systems.map_unit};
  if (options.height_unit) {
    Result<HeightUnit> stated = ReadHeightUnit(*options.height_unit);
    if (!stated) return stated;
    sources.stated = *std::move(stated);
  } else if (const std::string name = GDALGetRasterUnitType(dem.band.heights); !name.empty()) {
    Result<HeightUnit> unit = ReadHeightUnit(name);
    if (!unit) return unit;
    unit->source = "the band";
    if (!sources.file_system || std::abs(sources.file_system->metres - unit->metres) > 1e-9) {
      sources.band = *std::move(unit);
    }
  }
  return DecideHeightUnit(sources, dem.assumptions);
}

bool CountsDown(const Systems& systems) {
  const bool replaced = systems.call_flag == "--crs";
  return (systems.call && systems.call->down) || (systems.file && systems.file->down && !replaced);
}

// What the format itself has heights above, where GDAL does not say it.
std::string DatumOfFormat(GDALDatasetH dataset) {
  const std::string driver = GDALGetDriverShortName(GDALGetDatasetDriver(dataset));
  if (driver == "SRTMHGT") return ", though heights of HGT are above EGM96 as a rule";
  if (driver == "DTED") return ", though heights of DTED are above mean sea level as a rule";
  return "";
}

void AssumeDatum(GDALDatasetH dataset, const Systems& systems, Assumptions& assumptions) {
  const std::string lost =
      systems.file && systems.file->names_datum
          ? " beside --crs, which takes the place of the file's " + systems.file->name
          : "";
  assumptions.push_back(
      {"vertical-datum",
       "heights are taken as above the ellipsoid, for nothing names a vertical datum" + lost +
           DatumOfFormat(dataset) +
           "; state one with --vertical-datum, such as EPSG:5773 (EGM96 height) or ellipsoid"});
}

}  // namespace

Result<ValueScale> ReadValueScale(OpenedDem& dem, const std::optional<std::string>& file_crs) {
  const GDALRasterBandH band = dem.band.heights;
  const double scale = GDALGetRasterScale(band, nullptr);
  const double offset = GDALGetRasterOffset(band, nullptr);
  if (!std::isfinite(scale) || scale == 0 || !std::isfinite(offset)) {
    return Error{ErrorCode::kUnsupportedData,
                 "the band's scale (" + std::to_string(scale) + ") or offset (" +
                     std::to_string(offset) + ") is of no use; set them with gdal_edit",
                 "unsupported-type"};
  }
  const Result<Systems> systems = ReadSystems(file_crs, dem.options);
  if (!systems) return systems.error();
  Result<HeightUnit> unit = DecideUnit(dem, *systems);
  if (!unit) return std::move(unit.error());
  double metres = unit->metres;
  if (CountsDown(*systems)) {
    metres = -metres;
    const bool by_call = systems->call && systems->call->down;
    const HeightSystem& down = by_call ? *systems->call : *systems->file;
    const std::string remedy =
        by_call ? "name a system of heights with " + systems->call_flag
                : "name the map's own system with one of heights with --crs, as EPSG:32633+5773";
    dem.assumptions.push_back(
        {"depths", "values are depths, for " + down.name +
                       " counts downwards: heights are their negatives; where they are heights "
                       "already, " +
                       remedy});
  }
  if (!systems->names_datum) AssumeDatum(dem.dataset, *systems, dem.assumptions);
  return ValueScale{scale * metres, offset * metres};
}

}  // namespace farhorizon
