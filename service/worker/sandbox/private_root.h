#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace farhorizon {

/// The file system of one worker.
struct PrivateRootPlan {
  std::filesystem::path directory;               ///< the worker's own; its `in` is read-only
  std::vector<std::filesystem::path> read = {};  ///< files and folders beside the system's own
};

/// Makes the process that called, in user, mount and PID namespaces of its own, root of a file
/// system in memory that has /usr and the loader's tables read-only, a few devices, /proc of the
/// namespace alone, and what the plan names, all at their usual places. The current folder becomes
/// `directory`. False where the kernel refuses; then the process must not go on.
bool EnterPrivateRoot(const PrivateRootPlan& plan);

/// Makes the user "nobody" of a user namespace that was just made stand for the user and the group
/// outside. False where the kernel refuses.
bool MapToNobody(unsigned outer_user, unsigned outer_group);

}  // namespace farhorizon
