#pragma once

#include <gtest/gtest.h>

#include "core/terrain/dem.h"
#include "tests/support/engine_agreement.h"

namespace farhorizon {

/// Both engines give the same edges, with witnesses that hold: EngineOffence, for a test. On
/// failure: what differs on the smallest DEM found, its drawing to be put into a test, and the name
/// of an SVG of the kinetic sweep over it, half way up its relief.
testing::AssertionResult EnginesAgree(const Dem& dem, const Engines& engines = {});

}  // namespace farhorizon
