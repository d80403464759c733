#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/geo/proj_session.h"

namespace farhorizon {

/// How a reference system counts heights.
struct HeightAxis {
  double unit_m = 1;
  std::string unit = "metre";  ///< as PROJ names it
  bool down = false;           ///< it counts depths
};

/// The axis of heights of `crs`, a 3-D, vertical, compound or bound system; nullopt where it has
/// none.
std::optional<HeightAxis> HeightAxisOf(const ProjSession& session, const PJconsts* crs);

/// The vertical part of a compound system; null for any other.
ProjObject HeightsOf(const ProjSession& session, const PJconsts* crs);

/// True where `crs` has heights whose datum is named, the ellipsoid of a 3-D system included. A
/// file that states no more than the unit of its heights has a vertical part of unknown datum.
bool NamesHeightDatum(const ProjSession& session, const PJconsts* crs);

/// True where `crs` has a vertical part whose datum is an ellipsoid, as the codes 5001 to 5033 of
/// GeoTIFF 1.0 have it.
bool IsAboveEllipsoid(const ProjSession& session, const PJconsts* crs);

/// True where the heights of `crs` are above mean sea level, without saying which (EPSG:5714,
/// EPSG:5715 and the like).
bool IsMeanSeaLevel(const ProjSession& session, const PJconsts* crs);

/// The vertical system that `text` names: a code, WKT, or the name of a datum as people say it
/// ("EGM96", "NAVD88").
/// Errors: kUnsupportedData, kinds "no-crs" and "unknown-crs", with the candidates' codes where a
///   name fits several.
Result<ProjObject> ReadVerticalSystem(ProjSession& session, const std::string& text);

/// The horizontal part of `crs`, without heights; keeps a shift that is bound to it.
/// Errors: kUnsupportedData, kind "unknown-crs".
Result<ProjObject> WithoutHeights(const ProjSession& session, ProjObject crs);

/// The horizontal part of `crs` with heights above its ellipsoid in metres: PROJ knows no way from
/// a 3-D system that counts them in another unit.
/// Errors: kUnsupportedData, kind "unknown-crs".
Result<ProjObject> WithEllipsoidalHeights(const ProjSession& session, ProjObject crs);

/// The horizontal part of `crs` with heights of the vertical system `heights`.
/// Errors: kUnsupportedData, kind "unknown-crs".
Result<ProjObject> WithHeights(const ProjSession& session, ProjObject crs, const PJconsts* heights);

}  // namespace farhorizon
