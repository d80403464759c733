#include "service/worker/spawner/spawner_process.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <optional>
#include <poll.h>
#include <set>
#include <signal.h>
#include <string>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/geo/reference_data.h"
#include "core/io/file.h"
#include "core/io/posix_file.h"
#include "service/worker/run_task.h"
#include "service/worker/spawner/contained_child.h"
#include "service/worker/spawner/fd_message.h"
#include "service/worker/worker_protocol.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A worker does all that is done once in a process: drivers, the database of reference systems, the
// geoid, tables of the C++ library.
constexpr const char* kWarmGrid =
    "ncols 3\nnrows 3\nxllcorner 7\nyllcorner 46\ncellsize 0.001\nNODATA_value -9999\n"
    "1 2 3\n2 3 1\n3 1 2\n";

bool WarmUp() {
  std::error_code failure;
  fs::create_directory("in", failure);
  fs::create_directory("out", failure);
  const WorkerTask task{
      "in/warm.asc", "out", {{"crs", "EPSG:4326+5773"}, {"heightUnit", "m"}}, 100, 1};
  return WriteFile(task.input, kWarmGrid) && WriteTaskFile(".", task) && RunTask(true) == 0;
}

// A thread would not be copied, and what it held would be locked for good in each copy. One that
// was joined may still be seen for a moment.
bool HasOneThread() {
  for (int tries = 0; tries < 200; ++tries) {
    const fs::directory_iterator threads("/proc/self/task");
    if (std::distance(begin(threads), end(threads)) == 1) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

// One for a job and one for a look at an upload, which come in turns.
constexpr std::size_t kWaiting = 2;

// To be made when the process is warm.
class SpawnerLoop {
 public:
  // Which layers there are, as a child finds out.
  bool FindLayers() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return false;
    const UniqueFd reading(ends[0]);
    UniqueFd writing(ends[1]);
    LaunchOrder order;
    std::error_code failure;
    order.directory = fs::current_path(failure);
    if (failure) return false;
    Result<ContainedChild> child = StartContained({.trial = true});
    if (!child || !GiveOrder(*child, order, writing.get())) return false;
    writing.Reset();
    std::array<char, sizeof(layers_)> bytes{};
    std::size_t filled = 0;
    while (filled < bytes.size()) {
      const std::int64_t got = ReadSome(reading.get(), std::span(bytes).subspan(filled));
      if (got <= 0) return false;
      filled += static_cast<std::size_t>(got);
    }
    std::memcpy(&layers_, bytes.data(), sizeof(layers_));
    ::waitpid(child->pid, nullptr, 0);
    return true;
  }

  bool SayReady() const {
    return SendFds(kSpawnerSocket,
                   json({{"namespaces", layers_.namespaces},
                         {"privateRoot", layers_.private_root},
                         {"landlock", layers_.landlock},
                         {"seccomp", layers_.seccomp}})
                       .dump(),
                   {});
  }

  // Until the service closes its end.
  void Serve(int ended_children) {
    for (;;) {
      Refill();
      std::array<struct pollfd, 2> waits = {
          {{kSpawnerSocket, POLLIN, 0}, {ended_children, POLLIN, 0}}};
      if (::poll(waits.data(), waits.size(), -1) < 0 && errno != EINTR) return;
      if (waits[1].revents != 0) Reap(ended_children);
      if (waits[0].revents != 0 && !Answer()) return;
    }
  }

 private:
  bool Answer() {
    FdMessage asked = ReceiveFds(kSpawnerSocket);
    if (asked.text.empty()) return false;
    Result<LaunchOrder> order = ReadOrder(asked.text);
    if (!order || asked.descriptors.size() != 1) return false;
    Result<ContainedChild> child = Give(*order, asked.descriptors[0].get());
    if (!child) {
      const Error& error = child.error();
      return SendFds(kSpawnerSocket,
                     json({{"code", ErrorCodeName(error.code)}, {"message", error.message}}).dump(),
                     {});
    }
    return SendFds(kSpawnerSocket, json({{"pid", child->pid}}).dump(),
                   {child->pidfd.get(), child->status.get()});
  }

  // A child that has the order: one that waited, unless all have died.
  Result<ContainedChild> Give(const LaunchOrder& order, int messages) {
    while (!waiting_.empty()) {
      ContainedChild child = std::move(waiting_.front());
      waiting_.pop_front();
      if (GiveOrder(child, order, messages)) return child;
    }
    Result<ContainedChild> child = StartOne();
    if (child && !GiveOrder(*child, order, messages)) {
      return Error{ErrorCode::kIo, "start a worker: it died at once", "worker-not-started"};
    }
    return child;
  }

  Result<ContainedChild> StartOne() {
    Result<ContainedChild> child = StartContained({.layers = layers_,
                                                   .own_filter = Ready(own_filter_),
                                                   .other_filter = Ready(other_filter_),
                                                   .reference_data = reference_data_});
    if (child) keepers_.insert(child->pid);
    return child;
  }

  // Children that wait, so that an order need not. Failures are left to the next order.
  void Refill() {
    bool more = true;
    while (more && waiting_.size() < kWaiting) {
      Result<ContainedChild> child = StartOne();
      more = child.has_value();
      if (more) waiting_.push_back(std::move(*child));
    }
  }

  // Reaps keepers. Where there are no PID namespaces, a process that a worker left has this one for
  // its parent: it is ended.
  void Reap(int ended_children) {
    struct signalfd_siginfo info {};
    while (::read(ended_children, &info, sizeof(info)) > 0) {
    }
    for (pid_t pid = 0; (pid = ::waitpid(-1, nullptr, WNOHANG)) > 0;) keepers_.erase(pid);
    std::ifstream children("/proc/self/task/" + std::to_string(::getpid()) + "/children");
    for (pid_t pid = 0; children >> pid;) {
      if (!keepers_.contains(pid)) ::kill(pid, SIGKILL);
    }
  }

  static const SyscallFilter* Ready(const std::optional<SyscallFilter>& filter) {
    return filter ? &*filter : nullptr;
  }

  std::optional<SyscallFilter> own_filter_ = MakeSyscallFilter(kWorkerPid, false);
  std::optional<SyscallFilter> other_filter_ = MakeSyscallFilter(kWorkerPid, true);
  // Greater than those that a child replaces: they were taken when it was opened.
  const int reference_data_ = ReferenceDataFd();
  SandboxLayers layers_;
  std::set<pid_t> keepers_;
  std::deque<ContainedChild> waiting_;
};

}  // namespace

int RunSpawner() {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  ::prctl(PR_SET_NAME, "farhorizon-spwn");
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &signals, nullptr);
  const UniqueFd ended_children(::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK));
  if (ended_children && WarmUp() && HasOneThread()) {
    SpawnerLoop loop;
    if (loop.FindLayers() && loop.SayReady()) {
      loop.Serve(ended_children.get());
      return 0;
    }
  }
  std::fprintf(stderr, "farhorizon: the process that starts workers cannot get ready\n");
  return 70;
}

}  // namespace farhorizon
