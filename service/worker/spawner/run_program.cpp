#include "service/worker/spawner/run_program.h"

#include <cstdlib>
#include <unistd.h>

namespace farhorizon {

namespace {

// All of a worker's environment: of the parent's, only the options of the sanitizers.
std::vector<std::string> Environment(const std::filesystem::path& directory) {
  std::vector<std::string> variables = {"LANG=C.UTF-8", "TMPDIR=" + (directory / "out").string()};
  for (const char* name : {"ASAN_OPTIONS", "UBSAN_OPTIONS"}) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): one thread
    if (value != nullptr) variables.push_back(std::string(name) + "=" + value);
  }
#if defined(__SANITIZE_ADDRESS__)
  variables.emplace_back("LSAN_OPTIONS=detect_leaks=0");  // it would trace the process
#endif
  return variables;
}

}  // namespace

std::vector<char*> ArgumentPointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

void RunProgram(const LaunchOrder& order) {
  std::vector<std::string> words = {order.program, "worker"};
  if (order.probe_only) words.emplace_back("--probe");
  std::vector<std::string> variables = Environment(order.directory);
  const std::vector<char*> arguments = ArgumentPointers(words);
  const std::vector<char*> environment = ArgumentPointers(variables);
  ::execve(order.program.c_str(), arguments.data(), environment.data());
}

}  // namespace farhorizon
