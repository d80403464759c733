#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/trace/contours.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The state of the kinetic sweep when the plane has just passed a height ([Archambault03] chapter
/// 3), and the adaptive sweep's candidates there. For drawing: all points are in floating point.
struct SweepTrace {
  std::int32_t height = 0;  ///< of the plane, quanta; ground at or above it is in the slice
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  std::vector<std::vector<PlanPoint>> contours;  ///< of the slice, as ContoursAt gives them
  /// Merged hulls: disjoint and convex; a point where a hull has just begun.
  std::vector<std::vector<PlanPoint>> hulls;
  struct Bitangent {
    std::array<PlanPoint, 2> contacts;
    bool active = false;  ///< some line beside it misses all hulls
  };
  std::vector<Bitangent> bitangents;  ///< four for each two hulls
  /// Candidates of the adaptive sweep that cross the height.
  std::vector<std::array<PlanPoint, 2>> candidates;
  /// The slice points of the edges found to be horizon edges so far.
  std::vector<PlanPoint> horizon_points;
};

/// Sweeps down to `height`, in quanta, with the kinetic engine, and finds the candidates of the
/// adaptive one.
///
/// Errors: kInvalidArgument, kind no-such-level, where the height is above the summit or below the
/// lowest ground; those of FindHorizonKinetic.
/// Cost: that of both sweeps; some hundred bytes for each two hulls.
Result<SweepTrace> TraceSweep(const Terrain& terrain, std::int32_t height,
                              const RunControl& control);

}  // namespace farhorizon
