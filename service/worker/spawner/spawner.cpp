#include "service/worker/spawner/spawner.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/io/file.h"
#include "service/worker/spawner/fd_message.h"
#include "service/worker/spawner/run_program.h"
#include "service/worker/spawner/spawner_process.h"
#include "service/worker/worker_protocol.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kMostTries = 4;

Error NotStarted(const std::string& what) {
  return {ErrorCode::kIo, "start a worker: " + what, "worker-not-started"};
}

// What posix_spawn is given; freed with the object.
class SpawnActions {
 public:
  SpawnActions(int socket, const fs::path& folder) {
    ::posix_spawn_file_actions_init(&files_);
    ::posix_spawn_file_actions_addopen(&files_, 0, "/dev/null", O_RDWR, 0);
    ::posix_spawn_file_actions_addopen(&files_, 1, "/dev/null", O_RDWR, 0);
    ::posix_spawn_file_actions_adddup2(&files_, socket, kSpawnerSocket);
    ::posix_spawn_file_actions_addopen(&files_, kWorkerMessageFd, "/dev/null", O_RDWR, 0);
    ::posix_spawn_file_actions_addclosefrom_np(&files_, kSpawnerSocket + 1);
    ::posix_spawn_file_actions_addchdir_np(&files_, folder.c_str());
    ::posix_spawnattr_init(&attributes_);
    sigset_t signals;
    ::sigfillset(&signals);
    ::posix_spawnattr_setsigdefault(&attributes_, &signals);
    ::sigemptyset(&signals);
    ::posix_spawnattr_setsigmask(&attributes_, &signals);
    // In a session of its own: the service alone decides what becomes of Ctrl-C.
    ::posix_spawnattr_setflags(&attributes_,
                               POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSID);
  }
  ~SpawnActions() {
    ::posix_spawn_file_actions_destroy(&files_);
    ::posix_spawnattr_destroy(&attributes_);
  }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;

  [[nodiscard]] const posix_spawn_file_actions_t* files() const { return &files_; }
  [[nodiscard]] const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

/// A folder for what the spawner does to get ready, gone with this object; "" where none can be
/// made.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code failure;
    for (const fs::path& place : {fs::temp_directory_path(failure), fs::path("/dev/shm")}) {
      std::string name = (place / "farhorizon-XXXXXX").string();
      if (path_.empty() && ::mkdtemp(name.data()) != nullptr) path_ = name;
    }
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Of the service's environment, only the options of the sanitizers.
std::vector<std::string> Environment() {
  std::vector<std::string> variables = {"LANG=C.UTF-8"};
  for (const char* name : {"ASAN_OPTIONS", "UBSAN_OPTIONS", "LSAN_OPTIONS"}) {
    const char* value = ::secure_getenv(name);  // NOLINT(concurrency-mt-unsafe): none is ever set
    if (value != nullptr) variables.push_back(std::string(name) + "=" + value);
  }
  return variables;
}

Result<SandboxLayers> ReadLayers(const std::string& text) {
  const json said = json::parse(text, nullptr, false);
  if (!said.is_object()) return NotStarted("the process that starts workers did not get ready");
  return SandboxLayers{said.value("namespaces", false), said.value("privateRoot", false),
                       said.value("landlock", 0), said.value("seccomp", false)};
}

}  // namespace

Result<std::unique_ptr<Spawner>> Spawner::Start(std::string program) {
  std::unique_ptr<Spawner> spawner(new Spawner(std::move(program)));
  const std::lock_guard lock(spawner->mutex_);
  if (Status started = spawner->StartProcess(); !started) return std::move(started.error());
  return spawner;
}

Spawner::~Spawner() { EndProcess(); }

// Not by its socket alone: somebody may have stopped it.
void Spawner::EndProcess() {
  socket_.Reset();
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(std::exchange(pid_, -1), nullptr, 0);
}

Status Spawner::StartProcess() {
  EndProcess();
  const ScratchFolder folder;
  if (folder.path().empty()) {
    return NotStarted("neither TMPDIR nor /dev/shm can be written to; make one writable");
  }
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return NotStarted("no socket for the process that starts workers");
  }
  UniqueFd own(ends[0]);
  // A spawner that does not answer is as good as dead.
  const struct timeval most { 30, 0 };
  ::setsockopt(own.get(), SOL_SOCKET, SO_RCVTIMEO, &most, sizeof(most));
  // posix_spawn opens the first descriptors before it copies this one.
  const UniqueFd theirs(::fcntl(ends[1], F_DUPFD_CLOEXEC, kSpawnerSocket + 1));
  ::close(ends[1]);
  const SpawnActions actions(theirs.get(), folder.path());
  std::vector<std::string> words = {"farhorizon", "worker", "--spawner"};
  std::vector<std::string> variables = Environment();
  const std::vector<char*> arguments = ArgumentPointers(words);
  const std::vector<char*> environment = ArgumentPointers(variables);
  const int failed = ::posix_spawn(&pid_, program_.c_str(), actions.files(), actions.attributes(),
                                   arguments.data(), environment.data());
  if (failed != 0) {
    pid_ = -1;
    return NotStarted(std::generic_category().message(failed));
  }
  Result<SandboxLayers> layers = ReadLayers(ReceiveFds(own.get()).text);
  if (!layers) return std::move(layers.error());
  layers_ = *layers;
  socket_ = std::move(own);
  return Ok{};
}

Result<ChildProcess> Spawner::StartWorker(LaunchOrder order) {
  std::error_code failure;
  order.directory = fs::canonical(order.directory, failure);
  if (failure) return NotStarted("its folder is gone");
  if (order.program != kThisProgram) order.program = AbsolutePath(order.program);
  const std::lock_guard lock(mutex_);
  // Somebody may end the process again while it gets ready.
  Error last = NotStarted("");
  for (int tries = 0; tries < kMostTries; ++tries) {
    if (!socket_) {
      if (Status started = StartProcess(); !started) {
        last = std::move(started.error());
        continue;
      }
    }
    Result<ChildProcess> child = Ask(order);
    if (child || socket_) return child;
    last = std::move(child.error());
  }
  return last;
}

// The socket is gone afterwards where the process is.
Result<ChildProcess> Spawner::Ask(const LaunchOrder& order) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return Error{ErrorCode::kResourceExhausted, "start a worker: no pipe", "worker-not-started"};
  }
  UniqueFd reading(ends[0]);
  const UniqueFd writing(ends[1]);
  FdMessage answer;
  if (SendFds(socket_.get(), WriteOrder(order), {writing.get()})) {
    answer = ReceiveFds(socket_.get());
  }
  const json said = json::parse(answer.text, nullptr, false);
  if (!said.is_object()) {
    socket_.Reset();
    return NotStarted("the process that starts workers has died");
  }
  if (answer.descriptors.size() == 2) {
    return ChildProcess(said.value("pid", -1), std::move(answer.descriptors[0]),
                        std::move(answer.descriptors[1]), std::move(reading));
  }
  const std::optional<ErrorCode> code = ErrorCodeFromName(said.value("code", ""));
  return Error{code.value_or(ErrorCode::kIo), said.value("message", ""), "worker-not-started"};
}

SandboxLayers Spawner::Layers() {
  const std::lock_guard lock(mutex_);
  return layers_;
}

Status CheckWorkerProgram(const std::string& program) {
  struct stat about {};
  std::string why;
  if (::stat(program.c_str(), &about) != 0) {
    why = std::generic_category().message(errno);
  } else if (!S_ISREG(about.st_mode)) {
    why = "is no file";
  } else if (::access(program.c_str(), X_OK) != 0) {
    why = "may not be run (chmod +x)";
  } else {
    return Ok{};
  }
  return Error{ErrorCode::kIo,
               "worker.program \"" + program + "\": " + why +
                   "; name a program that is there, or leave the key out for this one",
               "worker-program"};
}

}  // namespace farhorizon
