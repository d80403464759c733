#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geo/frames.h"
#include "core/horizon/horizon.h"

namespace farhorizon {

/// Decimals of azimuths and of spans in files, and the steps that these decimals make.
inline constexpr int kAzimuthDecimals = 6;
inline constexpr double kAzimuthStep = 1e-6;
inline constexpr int kSpanDecimals = 7;
inline constexpr double kSpanStep = 1e-7;
/// The greatest amount by which a published skyline drop is too small, metres, or, where that is
/// more, as a share of itself.
inline constexpr double kSkylineDropStep = 5e-4;
inline constexpr double kSkylineDropShare = 0x1p-10;

/// Whether a measure has a value: kNotAfforded where the work budget ran out before it was found.
enum class Known { kYes, kNotAsked, kNotAfforded };

/// In which directions and where an edge is on the horizon, and how much the edge matters there, as
/// it is published.
///
/// azimuths: [from, to], degrees clockwise from true north at the edge's middle, 0 <= from < 180,
///   from < to <= from + 180, rising, disjoint. spans: [t0, t1] in [0, 1], t 0 at a and 1 at b,
///   rising, disjoint. Both are empty for an undecided edge.
/// Azimuths are rounded outwards to kAzimuthStep, spans to kSpanStep: a gap that is narrower than
/// that is closed.
/// angular_share: the sum of the azimuths' widths over 180. line_measure_m: the measure of the
///   lines on which the edge is the skyline, radians times metres across; the lines that meet a
///   convex region measure its perimeter [Crofton1868]. True to a millionth of itself.
/// skyline_drop_m: how much lower the skyline would be without the edge, on the line of sight where
///   that is most (skyline_drop.h): the truth, or less by up to kSkylineDropStep or
///   kSkylineDropShare of itself.
/// sights: whether all but the skyline drop have values. drop: whether that has one.
struct EdgeMeasures {
  std::vector<std::array<double, 2>> azimuths = {};
  std::vector<std::array<double, 2>> spans = {};
  double angular_share = 0;
  double line_measure_m = 0;
  double skyline_drop_m = 0;
  Known sights = Known::kYes;
  Known drop = Known::kYes;
};

/// One horizon edge as it is published, from post a to post b, both [column, row].
///
/// from, to: the positions of a and b. level_kept: the coarsest level that has the edge; unset
/// where no levels were built, or none keeps it. in_context: whether it is on the horizon with the
/// ground around the DEM too; unset where that was not asked. undecided: the work budget ran out
/// before the edge was decided; it has neither measures nor a witness.
struct HorizonFeature {
  std::array<std::int32_t, 2> a;
  std::array<std::int32_t, 2> b;
  Geodetic from;
  Geodetic to;
  EdgeMeasures measures;
  Witness witness;
  std::optional<int> level_kept;
  std::optional<bool> in_context;
  bool undecided = false;
};

/// The text of horizon.geojson: an RFC 7946 FeatureCollection with a LineString for each edge, one
/// feature to a line of text; an edge across the meridian of 180 degrees is cut there into a
/// MultiLineString of two. Measures of lines are printed to 10^-9, skyline drops to 10^-3.
///
/// Where some edges are undecided, the collection has `approximate` and their number as
/// `undecided`, and each of them has `undecided` instead of measures and witness. A measure that
/// the work budget did not suffice for is null; one that was not asked for is left out.
/// A witness that no double and two integers can write (witness.h) is null, and the edge has
/// `too_narrow`. Others are printed without loss: t as the shortest text of its double, directions
/// as integers. Directions are below 2^53, which every JSON reader keeps, except where cliffs of
/// 2^26 quanta and more differ by single quanta. There a few are up to 2^62; a reader that takes
/// all numbers for doubles, as JavaScript's JSON.parse does, rounds them to a line that may not be
/// a witness.
std::string WriteHorizonGeoJson(const std::vector<HorizonFeature>& features);

/// Reads back the text of WriteHorizonGeoJson. Errors: kUnsupportedData, kind "bad-geojson", with
/// the feature and the cause.
Result<std::vector<HorizonFeature>> ReadHorizonGeoJson(const std::string& text);

/// The property `context`, after others.
std::string ContextText(bool in_context);

/// "[[from,to],...]", as azimuths and spans are written. decimals: of each number, at most.
std::string IntervalsText(const std::vector<std::array<double, 2>>& intervals, int decimals);

}  // namespace farhorizon
