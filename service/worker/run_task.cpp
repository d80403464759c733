#include "service/worker/run_task.h"

#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <system_error>
#include <thread>
#include <vector>

#include "core/io/file.h"
#include "core/io/posix_file.h"
#include "core/pipeline/build.h"
#include "core/pipeline/level_plan.h"
#include "core/pipeline/terrain_input.h"
#include "service/clock.h"
#include "service/stage_timer.h"
#include "service/worker/run_echo.h"
#include "service/worker/worker_protocol.h"

namespace farhorizon {

namespace {

constexpr std::chrono::milliseconds kReportInterval{100};

// A failure is ignored: if nothing reads the messages, the supervisor is about to kill this
// process.
void Send(const WorkerMessage& message) {
  static std::mutex one_at_a_time;  // a long line is not one write of a pipe
  const std::lock_guard lock(one_at_a_time);
  [[maybe_unused]] const bool sent = WriteAll(kWorkerMessageFd, WriteMessage(message));
}

// Sends beats while it lives: a process that is stopped or starved is told from one that works.
class Heart {
 public:
  Heart() = default;
  ~Heart() {
    thread_.request_stop();
    thread_.join();
  }
  Heart(const Heart&) = delete;
  Heart& operator=(const Heart&) = delete;

 private:
  std::jthread thread_{[](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      Send(WorkerBeat{});
      Pause(kBeatInterval, stop);
    }
  }};
};

// Sends a new stage and the end of a stage at once, and the share of a stage that is done at most
// ten times a second.
Progress SendProgress() {
  struct Sent {
    std::optional<Stage> stage;
    std::chrono::steady_clock::time_point at;
  };
  return [last = std::make_shared<Sent>()](Stage stage, double done) {
    const auto now = std::chrono::steady_clock::now();
    if (last->stage == stage && done < 1 && now - last->at < kReportInterval) return;
    *last = {stage, now};
    Send(WorkerProgress{stage, done});
  };
}

AssumptionHandler SendAssumptions() {
  return [sent = std::make_shared<std::size_t>()](const Assumption& assumption) {
    if (++*sent <= kMostAssumptions) Send(assumption);
  };
}

std::int64_t PeakBytes() {
  struct rusage used {};
  return ::getrusage(RUSAGE_SELF, &used) == 0 ? std::int64_t{used.ru_maxrss} * 1024 : 0;
}

// A tile of three arc seconds and a degree has 1201 x 1201 posts: that, and half as much again, is
// read and placed in some 100 ms.
constexpr std::int64_t kMostProbedPosts = std::int64_t{1} << 21U;

// What a build does before its long work. The plan puts every post on the globe. Of large rasters
// the header alone is read: how long a probe takes depends on no number in a file.
Status Probe(const WorkerTask& task, const BuildOptions& options, const RunControl& control) {
  Result<std::unique_ptr<TerrainInput>> input =
      TerrainInput::Open(task.input, options, control, kMostProbedPosts);
  if (!input) return std::move(input.error());
  Send(WorkerSize{(*input)->posts()});
  if ((*input)->HeaderOnly()) return Ok{};
  Result<LevelPlan> plan = PlanLevels(**input, options);
  if (!plan) return std::move(plan.error());
  return Ok{};
}

Status Run(bool probe_only, StageTimer& timer) {
  Result<WorkerTask> task = ReadTaskFile();
  if (!task) return std::move(task.error());
  if (task->echo) return RunEcho(task->input, task->output);
  Result<BuildOptions> options = ParseOptions(task->parameters);
  if (!options) return std::move(options.error());
  options->max_posts = task->max_posts;
  options->threads = task->threads;
  RunControl control{.on_assumption = SendAssumptions()};
  if (probe_only) return Probe(*task, *options, control);
  control.progress = timer.Listen(SendProgress());
  return BuildArtifacts(task->input, task->output, *options, control);
}

// After its end no beat follows: the message that ends the work is the last.
Status RunBeating(bool probe_only, StageTimer& timer) {
  const Heart heart;
  return Run(probe_only, timer);
}

}  // namespace

int RunTask(bool probe_only) {
  try {
    StageTimer timer;
    Status status = RunBeating(probe_only, timer);
    if (!status) {
      Send(status.error());
      return 1;
    }
    Send(WorkerDone{timer.Seconds(), PeakBytes()});
    return 0;
  } catch (const std::bad_alloc&) {
    Send(Error{ErrorCode::kResourceExhausted,
               "the DEM needs more memory than a job may have; send a smaller one",
               "memory-limit"});
    return 1;
  } catch (const std::system_error& failure) {
    // Of a thread that could not be started: the machine has no process left.
    const bool scarce = failure.code() == std::errc::resource_unavailable_try_again;
    if (scarce) {
      Send(Error{ErrorCode::kResourceExhausted, "the machine has no thread left for the job",
                 "worker-not-started"});
      return 1;
    }
    std::fprintf(stderr, "internal error: %s\n", failure.what());
    return 70;
  } catch (const std::exception& bug) {
    std::fprintf(stderr, "internal error: %s\n", bug.what());
    return 70;
  }
}

}  // namespace farhorizon
