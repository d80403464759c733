#pragma once

namespace farhorizon {

/// The worker process: does the task of the working directory's task.json and writes its messages
/// to kWorkerMessageFd. probe_only: reads, places and plans as for a build, and builds nothing.
/// Returns the exit status: 0 done, 1 the data is at fault, 70 our own bug.
int RunTask(bool probe_only);

}  // namespace farhorizon
