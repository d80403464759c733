#pragma once

#include <functional>
#include <string>

namespace farhorizon {

/// The exit status of a process whose disk has failed: EX_IOERR, as systems name it.
constexpr int kExitDisk = 74;

/// Ends the process at once, with kExitDisk and a line of the log. For a sync that failed: the
/// kernel may have dropped what it could not write and call it clean, so that neither a later sync
/// nor a later read tells the truth. What is on the disk is read anew at the next start.
[[noreturn]] void EndAfterFailedSync(const std::string& what);

/// What EndAfterFailedSync calls before it ends the process. Set once, at the start.
void BeforeSyncEnd(std::function<void()> call);

}  // namespace farhorizon
