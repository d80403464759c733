#pragma once

#include "service/worker/worker_limits.h"

namespace farhorizon {

/// Limits the resources of this process, for good. own_user: whether its user namespace is its own.
/// Lower limits that there are already stay. False where the kernel refuses.
bool ApplyLimits(const WorkerLimits& limits, bool own_user);

/// Lets processes that somebody waits for go first, for good: where processors are scarce, this one
/// gets a tenth of what one of those gets.
void StandBack();

/// Takes all capabilities from this process and the way to get new ones, for good.
bool DropCapabilities();

/// Gives every signal its default action and blocks none.
void ResetSignals();

}  // namespace farhorizon
