#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// What encloses each worker process, as the kernel and the container let it: each layer holds
/// where others are refused. Resource limits, no new privileges and no capabilities always hold.
struct SandboxLayers {
  bool namespaces = false;    ///< of users, processes, network, IPC, host names, control groups
  bool private_root = false;  ///< a file system with nothing but what the work needs
  int landlock = 0;           ///< the version of the kernel's interface; 0: none
  bool seccomp = false;       ///< a list of the system calls that work needs

  friend bool operator==(const SandboxLayers&, const SandboxLayers&) = default;
};

/// The names of the layers that are active: of "namespaces", "private-root", "landlock", "seccomp".
std::vector<std::string> NamesOf(const SandboxLayers& layers);

/// Checks that `required`, the value of sandbox.require, is "none", "all" or names of layers with
/// commas between, and that each of them is active.
/// Errors: kInvalidArgument "invalid-config" for another word; kIo "sandbox-missing" with what is
///   missing and what to do.
Status CheckSandbox(const std::string& required, const SandboxLayers& layers);

}  // namespace farhorizon
