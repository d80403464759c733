#pragma once

#include <linux/filter.h>
#include <optional>
#include <sys/types.h>
#include <vector>

namespace farhorizon {

/// What decides about each system call of a process: a program of the kernel's packet filter.
using SyscallFilter = std::vector<struct sock_filter>;

/// The filter that leaves to the process `self` and its threads only the system calls that the work
/// of a worker needs. There are none to make processes, sockets, links, devices or keys, to trace
/// or signal others, to mount, or to undo a limit. nullopt where it cannot be made.
///
/// may_execute: leaves execve, for a program that is still to be started.
/// Cost: milliseconds; installing takes microseconds.
std::optional<SyscallFilter> MakeSyscallFilter(pid_t self, bool may_execute);

/// Puts this process and those that it starts under `filter`, for good. False where the kernel has
/// no filters. Requires: no new privileges are set, and the process has one thread.
bool Install(const SyscallFilter& filter);

}  // namespace farhorizon
