#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <thread>

#include "core/geo/reference_data.h"
#include "core/pipeline/version.h"
#include "service/cli/command.h"
#include "service/cli/signals.h"
#include "service/config/config.h"
#include "service/config/config_keys.h"
#include "service/config/load_config.h"
#include "service/handlers/routes.h"
#include "service/http/server.h"
#include "service/jobs/job_service.h"
#include "service/log.h"
#include "service/worker/spawner/spawner.h"

namespace farhorizon {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kPollInterval{100};
constexpr milliseconds kSendTimeout{3000};

struct ServeArguments {
  std::string config_file;
  bool print_config = false;
  std::map<std::string, std::string> flags;
};

JobServiceOptions JobOptions(const Config& config) {
  JobServiceOptions options = config.jobs;
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.workers = config.workers > 0 ? config.workers : cores;
  return options;
}

ServerOptions HttpOptions(const Config& config, const HostPort& address) {
  ServerOptions options = config.http;
  options.host = address.host;
  options.port = address.port;
  return options;
}

std::string BaseUrl(const Config& config, const HostPort& address, std::uint16_t port) {
  std::string base = config.public_url;
  if (base.empty()) {
    const bool any = address.host == "0.0.0.0" || address.host == "::";
    const bool literal = address.host.find(':') != std::string::npos;
    base = "http://" +
           (any       ? "localhost"
            : literal ? "[" + address.host + "]"
                      : address.host) +
           ":" + std::to_string(port);
  }
  while (base.back() == '/') base.pop_back();
  return base;
}

// Waits until no job runs, at most `most` or until a second signal.
void Drain(JobService& jobs, seconds most) {
  const auto deadline = std::chrono::steady_clock::now() + most;
  jobs.Drain();
  while (std::chrono::steady_clock::now() < deadline) {
    if (jobs.WaitIdle(kPollInterval)) break;
    if (WaitForSignal(milliseconds(0))) break;
  }
}

// Starts the process that starts workers, and checks that these are shut in as is asked for.
Status StartSpawner(const Config& config, JobServiceOptions& options) {
  Status known = CheckWorkerProgram(options.runner.worker_program);
  if (!known) return known;
  Result<std::unique_ptr<Spawner>> spawner = Spawner::Start(kThisProgram);
  if (!spawner) return std::move(spawner.error());
  const SandboxLayers layers = (*spawner)->Layers();
  std::string names;
  for (const std::string& name : NamesOf(layers)) names += (names.empty() ? "" : ",") + name;
  Log(names.empty() ? LogLevel::kWarning : LogLevel::kInfo, "sandbox",
      {{"layers", names}, {"landlock", std::int64_t{layers.landlock}}});
  options.runner.spawner = *std::move(spawner);
  return CheckSandbox(config.sandbox_require, layers);
}

int Serve(const Config& config) {
  if (Status there = CheckReferenceData(); !there) return ReportError(there.error());
  Result<HostPort> address = ReadHostPort(config.listen);
  if (!address) return ReportError(address.error());
  BlockSignals();  // before any thread is started, so that all of them block
  ConfigureLog(config.log);
  // The port first: a process that cannot bind it must not change the data.
  Result<std::unique_ptr<Server>> server = Server::Bind(HttpOptions(config, *address));
  if (!server) return ReportError(server.error());
  JobServiceOptions options = JobOptions(config);
  if (Status started = StartSpawner(config, options); !started) return ReportError(started.error());
  Result<std::unique_ptr<JobService>> jobs = JobService::Open(options);
  if (!jobs) return ReportError(jobs.error());
  const std::string base = BaseUrl(config, *address, (*server)->port());
  const Router router = BuildRouter({**jobs, base, config.max_body_bytes});
  (*server)->Serve(router);
  Log(LogLevel::kInfo, "serving",
      {{"url", base},
       {"port", std::int64_t{(*server)->port()}},
       {"version", std::string(Version())},
       {"data", config.jobs.data.string()}});
  std::optional<int> signal;
  while (!signal) signal = WaitForSignal(milliseconds(3'600'000));
  Log(LogLevel::kInfo, "stopping", {{"signal", std::int64_t{*signal}}});
  Drain(**jobs, config.drain_time);
  (*server)->Stop(kSendTimeout);
  (*jobs)->Stop();
  Log(LogLevel::kInfo, "stopped", {});
  return kExitDone;
}

int Run(const ServeArguments& arguments) {
  std::optional<std::filesystem::path> file;
  if (!arguments.config_file.empty()) file = arguments.config_file;
  Result<LoadedConfig> loaded = LoadConfig(file, ConfigEnvironment(), arguments.flags);
  if (!loaded) return ReportError(loaded.error());
  if (!arguments.print_config) return Serve(loaded->config);
  std::fputs(WriteConfig(loaded->config).c_str(), stdout);
  for (const auto& [name, origin] : loaded->origins) {
    std::fprintf(stderr, "%s: from %s\n", name.c_str(), origin.c_str());
  }
  return kExitDone;
}

// Every key with its variable, its meaning and its default.
std::string KeyTable() {
  const Config defaults;
  std::string table =
      "Keys of the configuration. Flags come before environment variables, these before the file,\n"
      "and that before the defaults; config/default.json has them all.\n";
  for (const ConfigKey& key : ConfigKeys()) {
    const ConfigValue value = key.get(defaults);
    const std::string text = key.IsText() ? "\"" + std::get<std::string>(value) + "\""
                                          : std::to_string(std::get<std::int64_t>(value));
    table +=
        "\n  " + key.name + ", " + key.Environment() + "\n      " + key.help + " (" + text + ")";
  }
  return table;
}

}  // namespace

void AddServe(Command& program, SelectedCommand& selected) {
  const auto arguments = std::make_shared<ServeArguments>();
  Command command = program.AddCommand("serve", "Run the job service");
  command.Add({.names = "--config", .type = "FILE", .help = "configuration, a JSON file"},
              arguments->config_file);
  const auto add = [&](const char* flag, const char* key, const char* type, const char* help) {
    command.Add({.names = flag, .type = type, .help = help},
                [arguments, key](const std::string& value) { arguments->flags[key] = value; });
  };
  add("--listen", "listen", "HOST:PORT", "address to listen on (127.0.0.1:8080)");
  add("--data", "data", "DIR", "folder for jobs, uploads and artifacts (farhorizon-data)");
  add("--workers", "workers", "N", "jobs at once (as many as there are cores)");
  command.AddSwitch("--print-config", "print the configuration that would be used, and stop",
                    arguments->print_config);
  command.SetFooter(KeyTable());
  command.Select(selected, [arguments] { return Run(*arguments); });
}

}  // namespace farhorizon
