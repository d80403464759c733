#pragma once

#include <optional>
#include <string>

#include "core/geo/proj_session.h"

namespace farhorizon {

/// Where a reference system or an operation is meant to be used.
struct AreaOfUse {
  /// Degrees; west > east across the antimeridian.
  double west = -180;
  double south = -90;
  double east = 180;
  double north = 90;
  std::string name = {};  ///< in words; "" where that is not stated

  [[nodiscard]] bool Contains(double lon_deg, double lat_deg) const;
  [[nodiscard]] bool IsWorld() const;
  /// This area with a margin all around it of `share` of its width and of its height.
  [[nodiscard]] AreaOfUse Widened(double share) const;
  /// The name in at most 70 bytes.
  [[nodiscard]] std::string ShortName() const;
};

/// The area of use of `object`, a system or an operation; of a system that came without its code,
/// that of the equivalent one that has a code. Nullopt where none is stated.
std::optional<AreaOfUse> AreaOfUseOf(const ProjSession& session, const PJconsts* object);

}  // namespace farhorizon
