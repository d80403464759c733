#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "core/base/result.h"
#include "core/io/unique_fd.h"
#include "service/worker/child_process.h"
#include "service/worker/sandbox/layers.h"
#include "service/worker/spawner/launch_order.h"

namespace farhorizon {

/// The service's end of its spawner, the process that starts workers. A spawner that died is
/// started again with the next worker; those that it had started died with it.
/// Threads: safe.
class Spawner {
 public:
  /// Starts the process and waits until it is ready. program: the path of this program.
  /// Errors: kIo "worker-not-started".
  static Result<std::unique_ptr<Spawner>> Start(std::string program);
  ~Spawner();
  Spawner(const Spawner&) = delete;
  Spawner& operator=(const Spawner&) = delete;

  /// Starts a worker. Errors: kIo, kResourceExhausted "worker-not-started".
  Result<ChildProcess> StartWorker(LaunchOrder order);

  /// What encloses each worker, as the spawner has found out.
  [[nodiscard]] SandboxLayers Layers();

 private:
  explicit Spawner(std::string program) : program_(std::move(program)) {}
  Status StartProcess();
  void EndProcess();
  Result<ChildProcess> Ask(const LaunchOrder& order);

  std::string program_;
  std::mutex mutex_;  // one order at a time; of all that follows
  UniqueFd socket_;
  pid_t pid_ = -1;
  SandboxLayers layers_;
};

/// Checks that `program`, a value of worker.program, can be run. Errors: kIo "worker-program".
Status CheckWorkerProgram(const std::string& program);

}  // namespace farhorizon
