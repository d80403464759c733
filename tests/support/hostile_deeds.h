#pragma once

#include <string>
#include <vector>

namespace farhorizon {

/// Tries what a worker that was taken over by a file would try, from its working folder
/// DATA/work/JOB; the names of those deeds that succeeded.
std::vector<std::string> HostileDeedsDone();

}  // namespace farhorizon
