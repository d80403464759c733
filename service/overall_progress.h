#pragma once

#include <string_view>

namespace farhorizon {

/// How much of a whole build is done, in percent from 0 to 99, from a stage and the share of it that
/// is done. A stage that is not known counts as the start.
int OverallPercent(std::string_view stage, double done);

}  // namespace farhorizon
