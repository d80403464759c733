// One layer of lines, a feature for each edge in the order given, in one transaction where
// the format has them. Fields are set by their place in kFields.
#include "core/io/horizon_vector.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include <cpl_conv.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include "core/io/antimeridian.h"
#include "core/io/file.h"
#include "core/io/gdal_session.h"

namespace farhorizon {

namespace {

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
struct DestroyFeature {
  void operator()(void* feature) const { OGR_F_Destroy(feature); }
};
struct ReleaseCrs {
  void operator()(void* crs) const { OSRRelease(crs); }
};

constexpr std::pair<const char*, OGRFieldType> kFields[] = {
    {"a_column", OFTInteger},         {"a_row", OFTInteger},
    {"b_column", OFTInteger},         {"b_row", OFTInteger},
    {"witness_t", OFTReal},           {"direction_columns", OFTInteger64},
    {"direction_rows", OFTInteger64}, {"level_kept", OFTInteger},
    {"azimuths", OFTString},          {"spans", OFTString},
    {"angular_share", OFTReal},       {"line_measure_m", OFTReal},
    {"skyline_drop_m", OFTReal},      {"context", OFTInteger}};

bool AddFields(OGRLayerH layer) {
  for (const auto& [name, type] : kFields) {
    const OGRFieldDefnH field = OGR_Fld_Create(name, type);
    const OGRErr added = OGR_L_CreateField(layer, field, 1);
    OGR_Fld_Destroy(field);
    if (added != OGRERR_NONE) return false;
  }
  return true;
}

bool CrossesAntimeridian(const HorizonFeature& edge) {
  return CutAtAntimeridian(edge.from, edge.to).size() > 1;
}

// The edge as a geometry of the layer's type.
OGRGeometryH LineOf(const HorizonFeature& edge, OGRwkbGeometryType type) {
  const bool multi = type == wkbMultiLineString25D;
  const OGRGeometryH lines = OGR_G_CreateGeometry(type);
  for (const std::array<Geodetic, 2>& part : CutAtAntimeridian(edge.from, edge.to)) {
    const OGRGeometryH line = multi ? OGR_G_CreateGeometry(wkbLineString25D) : lines;
    for (const Geodetic& g : part) OGR_G_AddPoint(line, g.lon_deg, g.lat_deg, g.height_m);
    if (multi) OGR_G_AddGeometryDirectly(lines, line);
  }
  return lines;
}

bool AddFeature(OGRLayerH layer, const HorizonFeature& edge) {
  const std::unique_ptr<void, DestroyFeature> feature(OGR_F_Create(OGR_L_GetLayerDefn(layer)));
  const std::int32_t numbers[] = {edge.a[0], edge.a[1], edge.b[0], edge.b[1]};
  for (int i = 0; i < 4; ++i) OGR_F_SetFieldInteger(feature.get(), i, numbers[i]);
  if (!edge.undecided) {  // otherwise these fields stay null
    if (edge.witness.exact) {
      OGR_F_SetFieldDouble(feature.get(), 4, edge.witness.t);
      OGR_F_SetFieldInteger64(feature.get(), 5, edge.witness.dc);
      OGR_F_SetFieldInteger64(feature.get(), 6, edge.witness.dr);
    }
    const EdgeMeasures& m = edge.measures;
    if (m.sights == Known::kYes) {
      const std::string azimuths = IntervalsText(m.azimuths, kAzimuthDecimals);
      const std::string spans = IntervalsText(m.spans, kSpanDecimals);
      OGR_F_SetFieldString(feature.get(), 8, azimuths.c_str());
      OGR_F_SetFieldString(feature.get(), 9, spans.c_str());
      OGR_F_SetFieldDouble(feature.get(), 10, m.angular_share);
      OGR_F_SetFieldDouble(feature.get(), 11, m.line_measure_m);
    }
    if (m.drop == Known::kYes) OGR_F_SetFieldDouble(feature.get(), 12, m.skyline_drop_m);
  }
  if (edge.level_kept) OGR_F_SetFieldInteger(feature.get(), 7, *edge.level_kept);
  if (edge.in_context) OGR_F_SetFieldInteger(feature.get(), 13, *edge.in_context ? 1 : 0);
  const OGRGeometryH line = LineOf(edge, OGR_L_GetGeomType(layer));
  return OGR_F_SetGeometryDirectly(feature.get(), line) == OGRERR_NONE &&
         OGR_L_CreateFeature(layer, feature.get()) == OGRERR_NONE;
}

// Writes all features. Returns false, with the cause in `session`, where the driver failed.
bool WriteLayer(const char* driver, const std::string& path,
                const std::vector<HorizonFeature>& features, const GdalSession& session) {
  const std::unique_ptr<void, CloseDataset> dataset(
      GDALCreate(GDALGetDriverByName(driver), path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) return false;
  const std::unique_ptr<void, ReleaseCrs> crs(OSRNewSpatialReference(nullptr));
  if (OSRImportFromEPSG(crs.get(), 4326) != OGRERR_NONE) return false;
  OSRSetAxisMappingStrategy(crs.get(), OAMS_TRADITIONAL_GIS_ORDER);
  const bool multi = std::any_of(features.begin(), features.end(), CrossesAntimeridian);
  const OGRLayerH layer =
      GDALDatasetCreateLayer(dataset.get(), "horizon", crs.get(),
                             multi ? wkbMultiLineString25D : wkbLineString25D, nullptr);
  if (layer == nullptr || !AddFields(layer)) return false;
  const bool transacted = GDALDatasetTestCapability(dataset.get(), ODsCTransactions) != 0;
  if (transacted && GDALDatasetStartTransaction(dataset.get(), FALSE) != OGRERR_NONE) return false;
  for (const HorizonFeature& feature : features) {
    if (!AddFeature(layer, feature)) return false;
  }
  if (transacted && GDALDatasetCommitTransaction(dataset.get()) != OGRERR_NONE) return false;
  GDALFlushCache(dataset.get());
  return !session.Failed();
}

}  // namespace

Status WriteHorizonVector(const std::vector<HorizonFeature>& features,
                          const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  const char* driver = ending == ".fgb" ? "FlatGeobuf" : ending == ".gpkg" ? "GPKG" : nullptr;
  if (driver == nullptr) {
    return Error{ErrorCode::kInvalidArgument, "no format goes with the ending of " +
                                                  path.filename().string() +
                                                  "; use .geojson, .fgb or .gpkg"};
  }
  GdalSession session(path);
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  // GeoPackage writes the date into its tables of contents: a fixed one keeps the bytes the same.
  CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", "1970-01-01T00:00:00.000Z");
  const std::string absolute = AbsolutePath(path).string();
  const bool written = WriteLayer(driver, absolute, features, session);
  CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", nullptr);
  // FlatGeobuf writes its file when the dataset is closed, so this failure may be the first.
  if (written && !session.Failed()) return Ok{};
  std::filesystem::remove(path, ignored);
  return Error{ErrorCode::kIo, "cannot write " + path.filename().string() + session.Complaint()};
}

}  // namespace farhorizon
