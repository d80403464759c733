#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/assumption.h"
#include "core/base/result.h"

namespace farhorizon {

/// A unit of heights, and who says that it is theirs.
struct HeightUnit {
  std::string name;  ///< "US survey foot"
  double metres = 1;
  std::string source = {};  ///< "the band", "EPSG:6360 of --vertical-datum"
};

/// The unit of length that people, formats and EPSG call `name`: metres, feet of all kinds, and
/// what is counted in either; words like "above sea level" after it are left out.
/// Errors: kUnsupportedData, kind "unknown-unit".
Result<HeightUnit> ReadHeightUnit(const std::string& name);

/// What is said of the unit of a DEM's heights.
struct HeightUnitSources {
  std::optional<HeightUnit> stated = {};       ///< --height-unit
  std::optional<HeightUnit> band = {};         ///< the band's own
  std::optional<HeightUnit> call_system = {};  ///< of the vertical system that the call names
  std::optional<HeightUnit> file_key = {};     ///< VerticalUnitsGeoKey
  std::optional<HeightUnit> file_system = {};  ///< of the file's vertical system
  std::string map_unit = {};                   ///< of the horizontal system, where that is no metre
};

/// The unit of heights, by one rule: what --height-unit states; else the band's own unit; else, of
/// the call's vertical system, the file's VerticalUnitsGeoKey and the file's vertical system, the
/// first that is not the metre, for a system that counts metres is often named for its datum alone;
/// else the metre. Adds to `assumptions`, with the code "height-unit", what a source says
/// otherwise, and the metre where none says anything, or the call's system alone over a map in
/// feet.
HeightUnit DecideHeightUnit(const HeightUnitSources& sources, Assumptions& assumptions);

}  // namespace farhorizon
