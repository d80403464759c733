#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geo/datum_operation.h"

namespace farhorizon {

/// The ways from a reference system to the globe, and the one of them that is taken.
struct DatumChoice {
  std::vector<DatumOperation> all;  ///< in the order of ListDatumOperations; may be empty
  std::size_t taken = 0;
  bool global = false;       ///< the system is used in the whole world
  bool shifts_plan = false;  ///< its horizontal datum is not WGS 84

  [[nodiscard]] const DatumOperation& Taken() const { return all[taken]; }
};

/// Takes one way from `source` to `globe` for all points of all DEMs in `source`, so that posts
/// which tiles share lie at one place.
///
/// Where `stated` is empty, the first is taken that needs no missing grid, is no ballpark, and, if
/// `source` is used in the whole world, holds there; else the first ballpark of the horizontal
/// datum. Otherwise the first one that has `stated` as its code or name, or as that of one of its
/// transformations; "ballpark" is the name of those without one. `all` is empty where there is no
/// way that keeps heights right.
/// Errors: kInvalidArgument, kind "invalid-argument", with those that there are, where `stated` is
///   none of them; kUnsupportedData, kind "no-geoid-grid", where its grids are missing.
Result<DatumChoice> TakeDatumOperation(const ProjSession& session, const PJconsts* source,
                                       const PJconsts* globe, const std::string& stated);

}  // namespace farhorizon
