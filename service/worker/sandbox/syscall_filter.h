#pragma once

namespace farhorizon {

/// Leaves to this process and its threads only the system calls that the work of a worker needs,
/// for good. There are none to make processes, sockets, links, devices or keys, to trace or signal
/// others, to mount, or to undo a limit. False where the kernel has no filters.
///
/// may_execute: leaves execve, for a program that is still to be started.
/// Requires: no new privileges are set, and the process has one thread.
bool RestrictSyscalls(bool may_execute);

}  // namespace farhorizon
