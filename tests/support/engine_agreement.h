#pragma once

#include <functional>
#include <string>

#include "core/horizon/find_horizon.h"
#include "core/horizon/kinetic/kinetic_horizon.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The engines to be compared: the library's own unless a test of the comparison says otherwise.
struct Engines {
  std::function<Result<Horizon>(const Terrain&)> adaptive = [](const Terrain& terrain) {
    return FindHorizon(terrain, {}, {});
  };
  std::function<Result<KineticHorizon>(const Terrain&)> kinetic = [](const Terrain& terrain) {
    return FindHorizonKinetic(terrain, {});
  };
  /// Under a work budget that does not suffice for much.
  std::function<Result<Horizon>(const Terrain&)> approximate = [](const Terrain& terrain) {
    return FindHorizon(terrain, {.work_budget = 200, .approximate = true}, {});
  };
  int posts_by_definition = 0;  ///< DEMs of at most so many posts are held to the brute force too
};

/// How the engines differ on `dem` from one another or from the definition: what failed, then the
/// edges. Empty where they agree, and on a DEM without any surface. Every witness is checked, and
/// that what is approximate is a superset, all beyond the horizon undecided. The error that is
/// documented for extreme heights, kinetic-too-large, is no offence; any other is, and so is an
/// InternalError.
std::string EngineOffence(const Dem& dem, const Engines& engines);

/// The smallest DEM to be had on which the engines still offend.
/// Requires: EngineOffence(dem, engines) is not empty.
Dem SmallestOffender(const Dem& dem, const Engines& engines);

/// How the engines offend on it, and its drawing.
std::string SmallestOffence(const Dem& dem, const Engines& engines);

}  // namespace farhorizon
