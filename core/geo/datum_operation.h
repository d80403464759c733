#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geo/area_of_use.h"
#include "core/geo/proj_session.h"

namespace farhorizon {

/// One of the ways that PROJ knows from a reference system to the globe.
struct DatumOperation {
  ProjObject way;
  /// The transformations between datums on the way, without the exact conversions: "NAD27 to WGS 84
  /// (4)". Empty where all is exact.
  std::vector<std::string> names;
  std::vector<std::string> codes;  ///< of `names`: "EPSG:1173", "" where one has none
  bool ballpark = false;           ///< some datum is taken for WGS 84 for want of a transformation
  bool ballpark_heights = false;   ///< heights of one datum are taken for those of another
  std::optional<double> accuracy_m;  ///< nullopt where it is unknown
  std::vector<std::string> missing_grids;
  AreaOfUse area;  ///< where it holds; the world where that is not stated

  /// `"NAD27 to WGS 84 (4)" (EPSG:1173, accuracy 10 m)`
  [[nodiscard]] std::string Described() const;
  /// The value of --datum-operation that states it.
  [[nodiscard]] std::string Stated() const;
};

/// The ways that PROJ knows from `source` to `globe`, in its order for the area where `source` is
/// used: grids installed before missing, large areas before small ones, then by accuracy.
std::vector<DatumOperation> ListDatumOperations(const ProjSession& session, const PJconsts* source,
                                                const PJconsts* globe);

/// The name of the operation that has the code `code`: "NAD27 to WGS 84 (4)" for "EPSG:1173"; ""
/// where PROJ's database has none.
std::string OperationName(const ProjSession& session, const std::string& code);

}  // namespace farhorizon
