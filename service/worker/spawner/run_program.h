#pragma once

#include <string>
#include <vector>

#include "service/worker/spawner/launch_order.h"

namespace farhorizon {

/// What exec takes for `texts`, which must outlive it.
std::vector<char*> ArgumentPointers(std::vector<std::string>& texts);

/// Becomes the program of `order`; returns where it cannot be run.
void RunProgram(const LaunchOrder& order);

}  // namespace farhorizon
