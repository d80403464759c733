#pragma once

#include "core/pipeline/ground_step.h"

namespace farhorizon {

/// The ground of a grid whose posts are a metre apart, columns eastwards, rows southwards.
inline constexpr GroundStep kMetreSteps{1, 0, 0, -1};

}  // namespace farhorizon
