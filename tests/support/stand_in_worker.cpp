// A worker that misbehaves in the way that the name of its input tells, to test the service.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <new>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "core/io/file.h"
#include "core/io/manifest.h"
#include "core/io/posix_file.h"
#include "core/io/sha256.h"
#include "service/worker/worker_protocol.h"
#include "tests/support/hostile_deeds.h"

namespace {

using namespace farhorizon;

void Send(const std::string& line) {
  if (!WriteAll(kWorkerMessageFd, line)) std::_Exit(3);
}

void WriteOne(const std::string& folder, const std::string& bytes) {
  if (!WriteFile(folder + "/report.json", bytes)) std::_Exit(4);
  const std::string manifest =
      WriteManifest({{"report.json", "application/json", bytes.size(), Sha256Hex(bytes)}});
  if (!WriteFile(folder + "/manifest.json", manifest)) std::_Exit(4);
}

bool Named(const WorkerTask& task, const char* word) {
  return task.input.find(word) != std::string::npos;
}

void Assume(const WorkerTask& task) {
  if (Named(task, "assumes")) {
    Send(WriteMessage(Assumption{"height-unit", "taken for feet; state it with --height-unit m"}));
    Send(WriteMessage(Assumption{"void", "-32768 is no data; state it with --nodata"}));
  }
  if (Named(task, "flood")) {
    for (int i = 0; i < 100; ++i) Send(WriteMessage(Assumption{"flood", std::to_string(i)}));
  }
}

// By the signal's own action: a sanitizer's handler writes a report first, which takes seconds.
void Crash() {
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
}

int Misbehave(const WorkerTask& task) {
  Assume(task);
  if (Named(task, "segv")) Crash();
  if (Named(task, "exit3")) return 3;
  if (Named(task, "hang")) std::this_thread::sleep_for(std::chrono::hours(1));
  if (Named(task, "nonsense")) Send("{\"done\": [[[[[[[[]]]]]]]]}\n");
  if (Named(task, "endless")) {
    for (;;) Send(std::string(4096, 'x'));
  }
  if (Named(task, "stopped")) std::raise(SIGSTOP);
  if (Named(task, "spin")) {
    for (volatile bool forever = true; forever;) {
    }
  }
  if (Named(task, "large")) {
    std::ofstream file(task.output + "/large");
    const std::string piece(1 << 20, 'x');
    while (file) file << piece << std::flush;
  }
  if (Named(task, "folder")) {
    const std::string piece(1 << 20, 'x');
    for (int i = 0; i < 40; ++i) {
      if (!WriteFile(task.output + "/" + std::to_string(i), piece)) return 4;
    }
    std::this_thread::sleep_for(std::chrono::hours(1));
  }
  if (Named(task, "hungry")) {
    try {
      const std::vector<char> memory(std::size_t{100} << 20U, 'x');
      [[maybe_unused]] const volatile char used = memory[task.input.size()];
    } catch (const std::bad_alloc&) {
      Send(WriteMessage(Error{ErrorCode::kResourceExhausted, "too much", "memory-limit"}));
      return 1;
    }
  }
  if (Named(task, "liar")) {
    WriteOne(task.output, "{}");
    if (!WriteFile(task.output + "/report.json", "{ }")) return 4;
    Send(WriteMessage(WorkerDone{}));
    return 0;
  }
  if (Named(task, "refused")) {
    Send(WriteMessage(
        Error{ErrorCode::kUnsupportedData, "no reference system; give --crs EPSG:4326", "no-crs"}));
    return 1;
  }
  if (Named(task, "escape")) {
    std::string done;
    for (const std::string& deed : HostileDeedsDone()) done += deed + "\n";
    WriteOne(task.output, "done:\n" + done);
    Send(WriteMessage(WorkerDone{}));
    return 0;
  }
  if (Named(task, "children")) {
    // Each in a session of its own, its parent gone: nobody's child.
    for (int i = 0; i < 5; ++i) {
      if (::fork() != 0) continue;
      ::setsid();
      if (::fork() == 0) std::this_thread::sleep_for(std::chrono::hours(1));
      std::_Exit(0);
    }
    return 3;
  }
  if (Named(task, "pipe")) {
    // Where pipes cannot be made there is no manifest, which is as bad.
    [[maybe_unused]] const int made = ::mkfifo((task.output + "/manifest.json").c_str(), 0600);
    Send(WriteMessage(WorkerDone{}));
    return 0;
  }
  if (Named(task, "slow")) {
    for (int i = 0; i < 20; ++i) {
      Send(WriteMessage(WorkerProgress{Stage::kSweep, i / 20.0}));
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  if (Named(task, "numbers")) {
    std::string text = "[0";
    for (int i = 1; i < 30'000; ++i) text += ", " + std::to_string(i * 7919);
    WriteOne(task.output, text + "]");
    Send(WriteMessage(WorkerDone{}));
    return 0;
  }
  WriteOne(task.output, "{\"descriptors\": " + std::to_string(::access("/proc/self/fd/4", F_OK)) +
                            ", \"environment\": " +
                            (std::getenv("SECRET") != nullptr ? "\"open\"" : "\"closed\"") + "}");
  Send(WriteMessage(WorkerDone{{{"sweep", 0.5}}}));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv, argv + argc);
  Result<WorkerTask> task = ReadTaskFile();
  if (!task) return 70;
  if (words.back() != "--probe") return Misbehave(*task);
  if (Named(*task, "unreadable")) {
    Send(WriteMessage(Error{ErrorCode::kResourceExhausted, "too large", "raster-too-large"}));
    return 1;
  }
  if (Named(*task, "probe-memory")) {
    Send(WriteMessage(Error{ErrorCode::kResourceExhausted, "too much", "memory-limit"}));
    return 1;
  }
  Assume(*task);
  if (Named(*task, "hungry")) Send(WriteMessage(WorkerSize{400}));
  if (Named(*task, "probe-hang")) std::this_thread::sleep_for(std::chrono::hours(1));
  if (Named(*task, "probe-segv")) Crash();
  Send(WriteMessage(WorkerDone{}));
  return 0;
}
