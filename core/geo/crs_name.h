#pragma once

#include <string>

#include "core/geo/proj_session.h"

namespace farhorizon {

/// "EPSG:4326", or "" where `object` has no code.
std::string CodeOf(const PJconsts* object);

/// `crs` as the authority has it, where PROJ knows one that is equivalent whatever its name; null
/// where it knows none.
ProjObject Identified(const ProjSession& session, const PJconsts* crs);

/// The name of `crs` for people and reports: "EPSG:4326" where it, or one that is equivalent, has a
/// code; "EPSG:4326+5773" where both its parts have one; else its own name; else, where it is
/// unnamed, its PROJ string, or the name of a vertical system's datum. It depends on nothing but
/// `crs`.
std::string NameOf(const ProjSession& session, const PJconsts* crs);

/// The name of the horizontal datum, or ensemble of datums, of a geographic or projected system.
std::string HorizontalDatumName(const ProjSession& session, const PJconsts* plan);
/// The name of the datum, or ensemble of datums, of a vertical or geodetic system.
std::string DatumName(const ProjSession& session, const PJconsts* crs);

/// True for "unknown", "unnamed" and the like, which writers put where a name is asked for.
bool IsUnnamed(const std::string& name);

}  // namespace farhorizon
