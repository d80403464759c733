#pragma once

#include "service/jobs/job_store.h"

namespace farhorizon {

/// How a process ends, in the lock file that it holds: so the next one knows whether a job may be
/// at fault. Written in place, where no full disk keeps it from being written.

/// What the lock file says of the process before this one.
PreviousEnd ReadEndMark(int lock);

/// From now on, an end without a further mark is one from without, unless the kernel has ended a
/// process of this machine for want of memory since the last call.
void MarkRunning(int lock);
/// The process ends as it should, or for a fault of the machine.
void MarkOrderly(int lock);

/// Marks an end by a signal of a fault (SIGSEGV, SIGABRT and the like) before it happens. For one
/// lock of a process, as long as it lives.
void MarkFatalSignals(int lock);

}  // namespace farhorizon
