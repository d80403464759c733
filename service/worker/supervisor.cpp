#include "service/worker/supervisor.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <optional>
#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/wait.h>
#include <unistd.h>

namespace farhorizon {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kLongestLine = 16384;
constexpr std::streamoff kLastWordsBytes = 2000;

/// Splits what a worker says into lines and keeps its last word.
class Listener {
 public:
  explicit Listener(const Progress& progress) : progress_(progress) {}

  /// False where it speaks nonsense.
  bool Hear(std::string_view bytes) {
    buffer_ += bytes;
    std::size_t end = 0;
    while ((end = buffer_.find('\n')) != std::string::npos) {
      if (!HearLine(std::string_view(buffer_).substr(0, end))) return false;
      buffer_.erase(0, end + 1);
    }
    return buffer_.size() <= kLongestLine;
  }
  [[nodiscard]] const std::optional<WorkerMessage>& last_word() const { return last_word_; }

 private:
  bool HearLine(std::string_view line) {
    std::optional<WorkerMessage> message = ReadMessage(line);
    if (!message || last_word_) return false;
    if (const auto* step = std::get_if<WorkerProgress>(&*message)) {
      if (progress_) progress_(step->stage, step->done);
    } else {
      last_word_ = std::move(message);
    }
    return true;
  }

  const Progress& progress_;
  std::string buffer_;
  std::optional<WorkerMessage> last_word_;
};

enum class Watched { kEnded, kStopped, kTimedOut, kNonsense };

/// Reads what there is; false where it is nonsense. open: cleared at the end of the stream.
bool ReadSome(const Child& child, Listener& listener, bool& open) {
  std::array<char, 8192> bytes{};
  const ssize_t size = ::read(child.messages(), bytes.data(), bytes.size());
  if (size < 0) return errno == EINTR || errno == EAGAIN;
  open = size > 0;
  return listener.Hear({bytes.data(), static_cast<std::size_t>(size)});
}

/// Listens until the worker ends, or somebody or the clock says stop.
Watched WatchChild(const Child& child, Listener& listener, int stop_event,
                   Clock::time_point deadline) {
  bool open = true;
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    if (left.count() <= 0) return Watched::kTimedOut;
    std::array<struct pollfd, 3> waits = {{{open ? child.messages() : -1, POLLIN, 0},
                                           {child.end(), POLLIN, 0},
                                           {stop_event, POLLIN, 0}}};
    const auto timeout = std::min<std::int64_t>(left.count(), 60'000);
    if (::poll(waits.data(), waits.size(), static_cast<int>(timeout)) < 0 && errno != EINTR) {
      return Watched::kNonsense;
    }
    if (waits[2].revents != 0) return Watched::kStopped;
    if (waits[0].revents != 0) {
      if (!ReadSome(child, listener, open)) return Watched::kNonsense;
    } else if (waits[1].revents != 0) {
      return Watched::kEnded;  // and nothing is left in the pipe
    }
  }
}

std::string LastWords(const std::filesystem::path& directory) {
  std::ifstream file(directory / "stderr.txt", std::ios::binary | std::ios::ate);
  if (!file) return {};
  const std::streamoff size = file.tellg();
  file.seekg(std::max<std::streamoff>(0, size - kLastWordsBytes));
  return {std::istreambuf_iterator<char>(file), {}};
}

WorkerOutcome Crashed(ErrorCode code, ErrorKind kind, std::string message) {
  return {WorkerEnd::kCrashed, {code, std::move(message), kind}, {}, {}};
}

WorkerOutcome TimedOut(const char* what) {
  return Crashed(ErrorCode::kResourceExhausted, "timeout",
                 std::string("the work took more than its share of ") + what +
                     "; send a smaller DEM or ask for fewer levels");
}

/// Judges an end that nobody asked for.
WorkerOutcome Judge(int status, const std::optional<WorkerMessage>& last_word) {
  if (WIFEXITED(status) && last_word) {
    if (const auto* done = std::get_if<WorkerDone>(&*last_word)) {
      if (WEXITSTATUS(status) == 0)
        return {WorkerEnd::kDone, {ErrorCode::kIo, ""}, done->timings, {}};
    } else if (const auto* error = std::get_if<Error>(&*last_word)) {
      if (WEXITSTATUS(status) == 1) return {WorkerEnd::kFailed, *error, {}, {}};
    }
  }
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU) return TimedOut("processor time");
    if (signal == SIGXFSZ) {
      return Crashed(ErrorCode::kResourceExhausted, "file-limit",
                     "the work wrote a file larger than the limit; ask for fewer triangles");
    }
    if (signal == SIGKILL) {  // not by us: the kernel, short of memory
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

}  // namespace

WorkerOutcome RunWorker(const WorkerCall& call, const Progress& progress,
                        const std::stop_token& stop) {
  const UniqueFd stop_event(::eventfd(0, EFD_CLOEXEC));
  const std::stop_callback wake(stop, [&stop_event] { ::eventfd_write(stop_event.get(), 1); });
  std::vector<std::string> arguments = {"worker"};
  if (call.probe_only) arguments.emplace_back("--probe");
  Result<Child> child = Child::Start(call.program, arguments, call.directory, call.limits);
  if (!child) return {WorkerEnd::kCrashed, std::move(child.error()), {}, {}};
  Listener listener(progress);
  const Clock::time_point deadline = Clock::now() + std::chrono::seconds(call.limits.wall_seconds);
  const Watched watched = WatchChild(*child, listener, stop_event.get(), deadline);
  if (watched != Watched::kEnded) child->Kill();
  const int status = child->Wait();
  WorkerOutcome outcome;
  switch (watched) {
    case Watched::kEnded:
      outcome = Judge(status, listener.last_word());
      break;
    case Watched::kStopped:
      outcome = {WorkerEnd::kStopped, {ErrorCode::kCancelled, "stopped", ""}, {}, {}};
      break;
    case Watched::kTimedOut:
      outcome = TimedOut("time");
      break;
    case Watched::kNonsense:
      outcome = Crashed(ErrorCode::kIo, "worker-crashed",
                        "the worker said what it should not; the fault is ours");
      break;
  }
  outcome.last_words = LastWords(call.directory);
  return outcome;
}

}  // namespace farhorizon
