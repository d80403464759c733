#pragma once

namespace farhorizon {

/// The descriptor of the spawner's socket to the service. It has kWorkerMessageFd open, too, to
/// nothing: what it does to get ready is a worker's work.
constexpr int kSpawnerSocket = 4;

/// The spawner: a process of one thread, started once by the service, in which GDAL and PROJ are
/// ready for work, and which starts each worker as a copy of itself, so that none has to load them.
///
/// First it says which layers the sandbox has here; then it answers each order with a child's pid,
/// pidfd and status pipe. The current folder is its own. Returns the exit status when the service
/// has ended; its children end with it.
int RunSpawner();

}  // namespace farhorizon
