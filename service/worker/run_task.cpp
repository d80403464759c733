#include "service/worker/run_task.h"

#include <chrono>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <unistd.h>

#include "core/io/dem_reader.h"
#include "core/io/file.h"
#include "core/pipeline/build.h"
#include "service/stage_timer.h"
#include "service/worker/message.h"

namespace farhorizon {

namespace {

constexpr int kMessages = 3;
constexpr std::chrono::milliseconds kBetweenReports{100};

void Say(const WorkerMessage& message) {
  const std::string line = WriteMessage(message);
  std::size_t said = 0;
  while (said < line.size()) {
    const ssize_t size = ::write(kMessages, line.data() + said, line.size() - said);
    if (size <= 0) return;  // nobody listens any more; the supervisor ends us
    said += static_cast<std::size_t>(size);
  }
}

/// Tells at once of a new stage, and of steps in it now and then.
Progress Telling() {
  return [stage = std::string(), last = std::chrono::steady_clock::time_point()](
             const char* name, double done) mutable {
    const auto now = std::chrono::steady_clock::now();
    if (stage == name && now - last < kBetweenReports) return;
    stage = name;
    last = now;
    Say(WorkerProgress{stage, done});
  };
}

Status Run(bool probe_only, StageTimer& timer) {
  Result<std::string> text = ReadFile("task.json", 1U << 20U);
  if (!text) return std::move(text.error());
  Result<WorkerTask> task = ReadTask(*text);
  if (!task) return std::move(task.error());
  Result<BuildOptions> options = ParseOptions(task->parameters);
  if (!options) return std::move(options.error());
  options->max_posts = task->max_posts;
  options->threads = task->threads;
  if (probe_only) {
    Result<Dem> dem = ReadDem(task->input, {options->max_posts, options->crs, options->nodata});
    if (!dem) return std::move(dem.error());
    return Done{};
  }
  return BuildArtifacts(task->input, task->output, *options, Watch{timer.Listen(Telling()), {}});
}

}  // namespace

int RunTask(bool probe_only) {
  try {
    StageTimer timer;
    Status status = Run(probe_only, timer);
    if (!status) {
      Say(status.error());
      return 1;
    }
    Say(WorkerDone{timer.Seconds()});
    return 0;
  } catch (const std::bad_alloc&) {
    Say(Error{ErrorCode::kResourceExhausted,
              "the DEM needs more memory than a job may have; send a smaller one", "memory-limit"});
    return 1;
  } catch (const std::exception& bug) {
    std::fprintf(stderr, "internal error: %s\n", bug.what());
    return 70;
  }
}

}  // namespace farhorizon
