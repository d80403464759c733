#pragma once

#include <sys/types.h>

#include "core/base/result.h"
#include "core/io/unique_fd.h"
#include "service/worker/sandbox/layers.h"
#include "service/worker/sandbox/syscall_filter.h"
#include "service/worker/spawner/launch_order.h"

namespace farhorizon {

/// A worker process inside its namespaces, seen from outside. It waits for its order, with the
/// database of reference systems open.
struct ContainedChild {
  pid_t pid = -1;  ///< of its keeper: the first process of its PID namespace
  UniqueFd pidfd;  ///< readable when the keeper has ended, and every process below it
  UniqueFd
      status;      ///< the read end of a pipe with the worker's status, as of waitpid, when it ends
  UniqueFd order;  ///< the socket to the worker
};

/// How a contained child is to be shut in.
struct Containment {
  SandboxLayers layers = {};
  /// Those for the second process of a PID namespace, as each worker is where there are such.
  const SyscallFilter* own_filter = nullptr;    ///< of this program
  const SyscallFilter* other_filter = nullptr;  ///< of another
  int reference_data = -1;  ///< as ReferenceDataFd has it; where -1, the worker opens its own
  /// Whether to find out which layers can be had: then one that cannot be is no failure, and the
  /// child does no work but writes to the message pipe which there are.
  bool trial = false;
};

/// The pid of a worker in its own PID namespace; its keeper is the first process.
constexpr pid_t kWorkerPid = 2;

/// Starts a keeper that starts a worker, waits for it and reports how it ended. The worker ends
/// with its keeper, the keeper with this process.
/// Requires: this process has one thread. Errors: kIo, kResourceExhausted "worker-not-started".
Result<ContainedChild> StartContained(const Containment& containment);

/// Has the worker shut itself into every layer and do the work of `order`, once. It has /dev/null
/// as standard input and output, the file stderr.txt of its directory as standard error, `messages`
/// as descriptor kWorkerMessageFd, and no other descriptor but, as this program, the database's.
/// False where it has died.
bool GiveOrder(const ContainedChild& child, const LaunchOrder& order, int messages);

}  // namespace farhorizon
