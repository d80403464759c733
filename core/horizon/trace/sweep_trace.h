#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/trace/contours.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Where the plane is when it has just passed a level, and what the kinetic sweep keeps there
/// ([Archambault03] chapter 3): to be looked at, so in floating point.
struct SweepTrace {
  std::int32_t level = 0;  ///< quanta; ground at or above it is in the slice
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  /// The slice's border inside the terrain, ground on one side: closed ones end where they begin, others
  /// at the border of the terrain or of a hole.
  std::vector<std::vector<PlanPoint>> contours;
  std::vector<std::vector<PlanPoint>>
      hulls;  ///< disjoint and convex; a point, where one has just begun
  struct Bitangent {
    std::array<PlanPoint, 2> touches;
    bool active = false;  ///< some line beside it misses all hulls
  };
  std::vector<Bitangent> bitangents;  ///< four for each two hulls
  std::vector<std::array<PlanPoint, 2>>
      candidates;  ///< of the adaptive sweep, that cross the level
  std::vector<PlanPoint>
      seen;  ///< where ground crosses the level on edges seen on the horizon so far
};

/// Sweeps down to `level`, in quanta, with the kinetic engine and to the candidates with the adaptive one.
///
/// Errors: kInvalidArgument, kind no-such-level, above the summit or below the lowest ground; those of
/// FindHorizonKinetic. Cost: that of both sweeps; some hundred bytes for each two hulls.
Result<SweepTrace> TraceSweep(const Terrain& terrain, std::int32_t level, const Watch& watch);

}  // namespace farhorizon
