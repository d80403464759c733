#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// What a reference system says of the heights that are counted in it.
struct HeightSystem {
  std::string name;  ///< "EPSG:6360", or a name
  std::string unit;  ///< "US survey foot"
  double unit_m = 1;
  bool down = false;         ///< depths: they grow downwards
  bool names_datum = false;  ///< false where no more than a unit is stated
};

/// The units of a reference system.
struct CrsUnits {
  std::optional<HeightSystem> heights;  ///< nullopt where the system has none
  std::string map_unit;                 ///< of the horizontal axes
  std::optional<double> map_unit_m;     ///< nullopt for angles
};

/// The units of the system that `crs` names, as GlobeTransform::Open takes it.
/// Errors: those of ParseCrs.
Result<CrsUnits> ReadCrsUnits(const std::string& crs);

/// What the vertical system that `vertical_datum` names says, as GlobeTransform::Open takes it;
/// nullopt for "ellipsoid".
/// Errors: those of ReadVerticalSystem.
Result<std::optional<HeightSystem>> ReadHeightSystem(const std::string& vertical_datum);

/// A unit of length of EPSG's list.
struct LengthUnit {
  std::string name;  ///< "Clarke's foot"
  double metres = 1;
};

/// The unit of length that has this name, in any case, or code ("9003") in EPSG's list; nullopt
/// where the list does not have it.
std::optional<LengthUnit> ListedLengthUnit(const std::string& name_or_code);

/// True for the words that stand for the ellipsoid instead of a vertical system, in any case.
bool IsEllipsoid(const std::string& vertical_datum);

}  // namespace farhorizon
