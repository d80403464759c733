#pragma once

#include <optional>
#include <string>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/geo/area_of_use.h"
#include "core/geo/datum_choice.h"
#include "core/geo/proj_session.h"
#include "core/geo/vertical_system.h"

namespace farhorizon {

/// A reference system and the operation that takes it to the globe.
struct GlobeWay {
  ProjObject crs = {};       ///< with its heights, as the call states them
  ProjObject to_globe = {};  ///< normalised: x east, y north; degrees on the globe
  std::optional<HeightAxis> height_axis = {};
  std::string name = {};               ///< of `crs`, as NameOf has it
  std::optional<AreaOfUse> area = {};  ///< of the horizontal part
  double full_turn = 0;                ///< in the unit of a geographic system; 0 for any other
  DatumChoice choice = {};             ///< of `to_globe`
  Assumptions assumptions = {};

  /// Metres upwards in one unit of the system's heights: negative where those are depths; 1 where
  /// it has none.
  [[nodiscard]] double HeightUnit() const;
};

/// Reads the system `crs`, joins heights to it or takes them from it as `vertical_datum` says, and
/// takes the operation that `datum_operation` states, or one for the system (TakeDatumOperation).
/// The arguments are those of GlobeTransform::Open, and so are the errors, except "outside-crs".
Result<GlobeWay> FindGlobeWay(ProjSession& session, const std::string& crs,
                              const std::string& vertical_datum,
                              const std::string& datum_operation);

}  // namespace farhorizon
