#pragma once

#include <optional>
#include <string>

#include "core/base/assumption.h"
#include "core/geo/datum_choice.h"
#include "core/geo/frames.h"

namespace farhorizon {

/// What to say of `choice` for the system `name`: the operation, its accuracy, better ones whose
/// grids are missing, and the one that suits at `middle`, the DEM's, where the one that is taken
/// does not hold there. Nullopt where nothing is open: the way is exact, or was stated and holds.
std::optional<Assumption> DatumAssumption(const DatumChoice& choice, const std::string& name,
                                          const std::optional<Geodetic>& middle, bool stated);

}  // namespace farhorizon
