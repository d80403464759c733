#pragma once

namespace farhorizon {

/// The worker process: does what task.json in the working directory says and tells descriptor 3.
/// Returns its exit status: 0 done, 1 the data's fault, 70 ours.
int RunTask(bool probe_only);

}  // namespace farhorizon
