#pragma once

#include <gtest/gtest.h>

#include "core/terrain/dem.h"

namespace farhorizon {

/// Both engines give the same edges, with witnesses that hold: EngineOffence, for a test. On failure: the
/// smallest DEM found on which they do not, its drawing, and what differs.
testing::AssertionResult EnginesAgree(const Dem& dem);

}  // namespace farhorizon
