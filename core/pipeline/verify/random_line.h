#pragma once

#include <random>

#include "core/horizon/lines/highest_over_line.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// How many random lines one claim is held to.
inline constexpr int kRandomLines = 1000;

/// A random line through the grid of `dem`: through a post or a point half way between posts, in
/// one of some four million directions. The same generator gives the same lines on every machine.
PlanLine RandomLine(const Dem& dem, std::mt19937_64& random);

}  // namespace farhorizon
