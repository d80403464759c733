#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "service/worker/sandbox/landlock.h"
#include "service/worker/spawner/launch_order.h"

namespace farhorizon {

/// The files that the kernel opens to start `program`: itself, the interpreters that it names (of
/// scripts "#!", of programs the loader), and what "env" finds for an interpreter. Real paths.
std::vector<std::filesystem::path> FilesToExecute(const std::filesystem::path& program);

/// What a worker may reach: its folder, of which only `out` to write to, and the packages' files,
/// which this program reads tables from; for another program all of /usr.
FileRights RightsOf(const LaunchOrder& order);

}  // namespace farhorizon
