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
  bool undecided = false;         ///< kept for want of work: there is no witness
};

/// horizon.geojson: an RFC 7946 FeatureCollection, a LineString a feature, one feature a line of
/// text.
///
/// Where some are undecided the collection says `approximate` and how many, and they have `undecided` in
/// the place of a witness.
/// Witnesses are printed without loss: t as the shortest text of its double, directions as integers.
/// Those are below 2^53, which every JSON reader keeps, unless cliffs of 2^26 quanta and more differ
/// by single ones; then a few are up to 2^62, and a reader that takes all numbers for doubles, as
/// JavaScript's JSON.parse does, rounds them to a line that may not hold.
std::string WriteHorizonGeoJson(const std::vector<HorizonFeature>& features);

/// Reads back what WriteHorizonGeoJson wrote. Errors: kUnsupportedData, with the feature and the
/// cause.
Result<std::vector<HorizonFeature>> ReadHorizonGeoJson(const std::string& text);

/// FlatGeobuf or GeoPackage, by the ending of `path` (".fgb", ".gpkg"), through OGR. Where an edge is
/// undecided its witness is null.
/// Errors: kIo where the driver failed.
Status WriteHorizonVector(const std::vector<HorizonFeature>& features,
                          const std::filesystem::path& path);

}  // namespace farhorizon
