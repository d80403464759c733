#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geo/frames.h"
#include "core/horizon/horizon.h"

namespace farhorizon {

/// One horizon edge as it is published. a, b: [column, row]. azimuths: degrees; spans: shares of the way
/// from a to b.
struct HorizonFeature {
  std::array<std::int32_t, 2> a;
  std::array<std::int32_t, 2> b;
  Geodetic from;
  Geodetic to;
  std::vector<std::array<double, 2>> azimuths;
  std::vector<std::array<double, 2>> spans;
  double angular_share = 0;
  double line_measure_m = 0;
  double skyline_drop_m = 0;
  Witness witness;
  std::optional<int> level_kept;  ///< unset where no levels were built, or none keeps it
  bool undecided = false;         ///< kept for want of work: there is no witness
};

/// horizon.geojson: an RFC 7946 FeatureCollection, a LineString a feature, one feature a line of
/// text. Azimuths to 10^-6 degrees, spans to 10^-7, measures to 10^-9.
///
/// Where some are undecided the collection says `approximate` and how many, and they have `undecided` in
/// the place of a witness.
/// Witnesses are printed without loss: t as the shortest text of its double, directions as integers.
/// Those are below 2^53, which every JSON reader keeps, unless cliffs of 2^26 quanta and more differ
/// by single ones; then a few are up to 2^62, and a reader that takes all numbers for doubles, as
/// JavaScript's JSON.parse does, rounds them to a line that may not hold.
std::string WriteHorizonGeoJson(const std::vector<HorizonFeature>& features);

/// "[[from,to],...]", as azimuths and spans stand in the file. decimals: of each number, at most.
std::string IntervalsText(const std::vector<std::array<double, 2>>& intervals, int decimals);
inline constexpr int kAzimuthDecimals = 6;
inline constexpr int kSpanDecimals = 7;

/// Reads back what WriteHorizonGeoJson wrote. Errors: kUnsupportedData, with the feature and the
/// cause.
Result<std::vector<HorizonFeature>> ReadHorizonGeoJson(const std::string& text);

/// FlatGeobuf or GeoPackage, by the ending of `path` (".fgb", ".gpkg"), through OGR. Azimuths and spans are
/// text, as in horizon.geojson. Where an edge is undecided they are null, and so are weights and witness.
/// Errors: kIo where the driver failed.
Status WriteHorizonVector(const std::vector<HorizonFeature>& features,
                          const std::filesystem::path& path);

}  // namespace farhorizon
