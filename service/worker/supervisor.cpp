#include "service/worker/supervisor.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <iterator>
#include <limits>
#include <optional>
#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "service/metrics.h"
#include "service/worker/folder_bytes.h"
#include "service/worker/message_reader.h"
#include "service/worker/worker_protocol.h"

namespace farhorizon {

namespace {

using Clock = std::chrono::steady_clock;

constexpr off_t kStderrTailBytes = 2000;
// Eight beats. The thread that sends them needs a moment of a processor a second, which a machine
// that swaps, or a start of the program on a slow disk, may refuse it for some.
constexpr std::chrono::seconds kLongestSilence{8 * kBeatInterval};

enum class WaitResult { kEnded, kStopped, kTimedOut, kSilent, kProtocolError, kFolderFull };

// Reads once; false where the bytes violate the protocol. open: cleared at the end of the stream.
bool ReadMessages(const ChildProcess& child, MessageReader& reader, bool& open) {
  std::array<char, 8192> bytes{};
  const ssize_t size = ::read(child.message_fd(), bytes.data(), bytes.size());
  if (size < 0) return errno == EINTR || errno == EAGAIN;
  open = size > 0;
  return reader.Add({bytes.data(), static_cast<std::size_t>(size)});
}

// Watches the folder of a worker, which the limit of each file alone does not bound.
class FolderWatch {
 public:
  // most: beside what is there now.
  FolderWatch(const std::filesystem::path& folder, std::int64_t most)
      : folder_(folder), most_(most + BytesIn(folder, std::numeric_limits<std::int64_t>::max())) {}

  // Looks once in kLookInterval; false where the folder has too much.
  bool Fits() {
    const Clock::time_point now = Clock::now();
    if (now < next_) return true;
    next_ = now + kLookInterval;
    return BytesIn(folder_, most_) <= most_;
  }
  [[nodiscard]] Clock::time_point next() const { return next_; }

 private:
  static constexpr std::chrono::seconds kLookInterval{1};

  const std::filesystem::path& folder_;
  std::int64_t most_;
  Clock::time_point next_ = Clock::now() + kLookInterval;
};

// Reads messages until the worker ends or is silent for too long, its folder is full, `stop_event`
// is readable or the deadline has passed.
WaitResult WaitForChild(const ChildProcess& child, MessageReader& reader, int stop_event,
                        Clock::time_point deadline, FolderWatch watch) {
  bool open = true;
  Clock::time_point heard = Clock::now();
  for (;;) {
    const Clock::time_point now = Clock::now();
    if (now >= deadline) return WaitResult::kTimedOut;
    if (now >= heard + kLongestSilence) return WaitResult::kSilent;
    if (!watch.Fits()) return WaitResult::kFolderFull;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(
        std::min({deadline, heard + kLongestSilence, watch.next()}) - now);
    std::array<struct pollfd, 3> waits = {{{open ? child.message_fd() : -1, POLLIN, 0},
                                           {child.pidfd(), POLLIN, 0},
                                           {stop_event, POLLIN, 0}}};
    const int ready = ::poll(waits.data(), waits.size(), static_cast<int>(left.count()));
    if (ready < 0 && errno != EINTR) return WaitResult::kProtocolError;
    // Later than was asked for: this process stood still itself, with its worker perhaps.
    if (ready == 0 && Clock::now() > now + left + kBeatInterval) heard = Clock::now();
    if (waits[2].revents != 0) return WaitResult::kStopped;
    if (waits[0].revents != 0) {
      if (!ReadMessages(child, reader, open)) return WaitResult::kProtocolError;
      heard = Clock::now();
    } else if (waits[1].revents != 0) {
      return WaitResult::kEnded;  // poll reported no unread message
    }
  }
}

std::string StderrTail(const std::filesystem::path& directory) {
  // The worker may have put something else into its place.
  const UniqueFd file(
      ::open((directory / "stderr.txt").c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat about {};
  if (!file || ::fstat(file.get(), &about) != 0 || !S_ISREG(about.st_mode)) return {};
  std::string tail(static_cast<std::size_t>(std::min<off_t>(about.st_size, kStderrTailBytes)),
                   '\0');
  const ssize_t got =
      ::pread(file.get(), tail.data(), tail.size(), about.st_size - std::ssize(tail));
  tail.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return tail;
}

WorkerOutcome Crashed(ErrorCode code, ErrorKind kind, std::string message) {
  return {WorkerEnd::kCrashed, {code, std::move(message), kind}};
}

WorkerOutcome TimedOut(const std::string& what) {
  return Crashed(
      ErrorCode::kResourceExhausted, "timeout",
      "the work took more than " + what + "; send a smaller DEM or ask for fewer levels");
}

// The outcome of a worker that ended by itself. status: as of waitpid.
WorkerOutcome OutcomeOfExit(int status, const std::optional<WorkerMessage>& final_message) {
  if (WIFEXITED(status) && final_message) {
    if (const auto* done = std::get_if<WorkerDone>(&*final_message)) {
      if (WEXITSTATUS(status) == 0) {
        return {WorkerEnd::kDone, {ErrorCode::kIo, ""}, done->timings, done->peak_bytes};
      }
    } else if (const auto* error = std::get_if<Error>(&*final_message)) {
      if (WEXITSTATUS(status) == 1) return {WorkerEnd::kFailed, *error};
    }
  }
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU) return TimedOut("its share of processor time");
    if (signal == SIGXFSZ) {
      return Crashed(ErrorCode::kResourceExhausted, "file-limit",
                     "the work wrote a file larger than the limit; ask for fewer triangles");
    }
    if (signal == SIGKILL) {  // sent by the kernel, which is out of memory
      return Crashed(ErrorCode::kResourceExhausted, "memory-limit",
                     "the work was ended for want of memory; send a smaller DEM");
    }
    return Crashed(ErrorCode::kIo, "worker-crashed",
                   "the worker died of signal " + std::to_string(signal) +
                       "; the fault is ours, the DEM that shows it is worth a report");
  }
  return Crashed(ErrorCode::kIo, "worker-crashed",
                 "the worker ended with status " + std::to_string(WEXITSTATUS(status)) +
                     "; the fault is ours, the DEM that shows it is worth a report");
}

WorkerOutcome Supervise(const WorkerCall& call, const RunControl& control) {
  const UniqueFd stop_event(::eventfd(0, EFD_CLOEXEC));
  const std::stop_callback wake(control.stop,
                                [&stop_event] { ::eventfd_write(stop_event.get(), 1); });
  if (!call.spawner) {
    return Crashed(ErrorCode::kIo, "worker-not-started", "there is nothing that starts workers");
  }
  Result<ChildProcess> child =
      call.spawner->StartWorker({call.program, call.probe_only, call.directory, call.limits});
  if (!child) return {WorkerEnd::kCrashed, std::move(child.error())};
  MessageReader reader(control);
  const Clock::time_point deadline = Clock::now() + std::chrono::seconds(call.limits.wall_seconds);
  const WaitResult waited = WaitForChild(*child, reader, stop_event.get(), deadline,
                                         FolderWatch(call.directory, call.limits.folder_bytes));
  if (waited != WaitResult::kEnded) child->Kill();
  const int status = child->Wait();
  WorkerOutcome outcome;
  switch (waited) {
    case WaitResult::kEnded:
      outcome = OutcomeOfExit(status, reader.final_message());
      break;
    case WaitResult::kStopped:
      outcome = {WorkerEnd::kStopped, {ErrorCode::kCancelled, "stopped", ""}};
      break;
    case WaitResult::kTimedOut:
      outcome =
          TimedOut(std::to_string(call.limits.wall_seconds) + " s, " + call.limits.wall_bound);
      break;
    case WaitResult::kFolderFull:
      outcome = Crashed(ErrorCode::kResourceExhausted, "file-limit",
                        "the work wrote more than the " +
                            std::to_string(call.limits.folder_bytes >> 20U) +
                            " MiB that all of its files may have; ask for fewer triangles");
      break;
    case WaitResult::kSilent:
      outcome = Crashed(ErrorCode::kIo, "worker-stuck",
                        "the worker stood still for " + std::to_string(kLongestSilence.count()) +
                            " seconds; the fault is ours, the DEM that shows it is worth a report");
      break;
    case WaitResult::kProtocolError:
      outcome = Crashed(ErrorCode::kIo, "worker-crashed",
                        "the worker said what it should not; the fault is ours");
      break;
  }
  outcome.posts = reader.posts();
  outcome.stderr_tail = StderrTail(call.directory);
  return outcome;
}

}  // namespace

WorkerOutcome RunWorker(const WorkerCall& call, const RunControl& control) {
  WorkerOutcome outcome = Supervise(call, control);
  const char* ended = outcome.end == WorkerEnd::kDone      ? "done"
                      : outcome.end == WorkerEnd::kStopped ? "stopped"
                                                           : nullptr;
  CountWorkerEnd(ended != nullptr ? ended : std::string(outcome.error.kind));
  return outcome;
}

}  // namespace farhorizon
