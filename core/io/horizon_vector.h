#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/io/horizon_features.h"

namespace farhorizon {

/// Writes horizon edges for GIS programs, through OGR: FlatGeobuf or GeoPackage, by the ending of
/// `path` (".fgb", ".gpkg"). An existing file is replaced. Same features, same bytes.
///
/// The layer is one of line strings, cut as in horizon.geojson: where an edge crosses the meridian
/// of 180 degrees, it is one of multi line strings throughout. Azimuths and spans are fields of
/// text, as in horizon.geojson. Fields without a value are null.
/// Errors: kInvalidArgument for another ending; kIo where the driver failed, with its message.
Status WriteHorizonVector(const std::vector<HorizonFeature>& features,
                          const std::filesystem::path& path);

}  // namespace farhorizon
