#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geo/frames.h"
#include "core/horizon/horizon.h"

namespace farhorizon {

/// One horizon edge as it is published. a, b: [column, row].
struct HorizonFeature {
  std::array<std::int32_t, 2> a;
  std::array<std::int32_t, 2> b;
  Geodetic from;
  Geodetic to;
  Witness witness;
  std::optional<int> level_kept;  ///< unset where no levels were built, or none keeps it
};

/// horizon.geojson: an RFC 7946 FeatureCollection, a LineString a feature, one feature a line of
/// text.
std::string WriteHorizonGeoJson(const std::vector<HorizonFeature>& features);

/// Reads back what WriteHorizonGeoJson wrote. Errors: kUnsupportedData, with the feature and the
/// cause.
Result<std::vector<HorizonFeature>> ReadHorizonGeoJson(const std::string& text);

/// FlatGeobuf or GeoPackage, by the ending of `path` (".fgb", ".gpkg"), through OGR.
/// Errors: kIo where the driver failed.
Status WriteHorizonVector(const std::vector<HorizonFeature>& features,
                          const std::filesystem::path& path);

}  // namespace farhorizon
