#include "service/cli/serve_process.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <sys/stat.h>
#include <thread>

#include "core/geo/reference_data.h"
#include "core/pipeline/version.h"
#include "service/cli/command.h"
#include "service/cli/notify.h"
#include "service/cli/signals.h"
#include "service/config/config_keys.h"
#include "service/handlers/callback_sender.h"
#include "service/handlers/key_gate.h"
#include "service/handlers/routes.h"
#include "service/http/server.h"
#include "service/jobs/job_service.h"
#include "service/log.h"
#include "service/pages/asset_folder.h"
#include "service/worker/spawner/spawner.h"

namespace farhorizon {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kPollInterval{100};
// After jobs.drainSeconds, of which eight by default: out within ten.
constexpr milliseconds kSendTimeout{1000};

JobServiceOptions JobOptions(const Config& config) {
  JobServiceOptions options = config.jobs;
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.workers = config.workers > 0 ? config.workers : cores;
  options.uploads.bounds.each = config.max_body_bytes;
  return options;
}

ServerOptions HttpOptions(const Config& config, const HostPort& address) {
  ServerOptions options = config.http;
  options.host = address.host;
  options.port = address.port;
  return options;
}

std::string BaseUrl(const Config& config, const HostPort& address, std::uint16_t port) {
  std::string base = config.http.public_url;
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

// Waits until no job runs, at most `most` or until a second signal to stop.
void Drain(JobService& jobs, seconds most) {
  const auto deadline = std::chrono::steady_clock::now() + most;
  jobs.Drain();
  while (std::chrono::steady_clock::now() < deadline) {
    if (jobs.WaitIdle(kPollInterval)) break;
    const std::optional<int> signal = WaitForSignal(milliseconds(0));
    if (signal && IsStopSignal(*signal)) break;
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

// CesiumJS for the viewer; nullptr where it is not installed. A folder that the configuration names
// has to have it.
Result<std::shared_ptr<const AssetFolder>> ReadCesium(const Config& config) {
  const std::filesystem::path folder = config.cesium.empty() ? InstalledCesium() : config.cesium;
  if (folder.empty()) {
    Log(LogLevel::kInfo, "no CesiumJS: the viewer shows numbers alone", {});
    return std::shared_ptr<const AssetFolder>();
  }
  Result<AssetFolder> read = AssetFolder::Read(folder);
  if (!read) return std::move(read.error());
  return std::make_shared<const AssetFolder>(*std::move(read));
}

// Half of the threads that look into uploads, at least, are for uploads that come by themselves.
Result<std::shared_ptr<Fetcher>> MakeFetcher(const Config& config) {
  FetchOptions options = config.fetch;
  options.at_once = std::min(options.at_once, std::max(1, config.http.upload_threads / 2));
  return Fetcher::Make(options);
}

void LogStart(ServeRole role, const LoadedConfig& loaded, const std::string& base,
              std::uint16_t port) {
  const Config& config = loaded.config;
  for (const std::string& variable : loaded.ignored) {
    Log(LogLevel::kWarning, "a variable names no key", {{"variable", variable}});
  }
  Log(LogLevel::kInfo, "serving",
      {{"role", std::string(role == ServeRole::kWork ? "work" : "serve")},
       {"url", base},
       {"port", std::int64_t{port}},
       {"version", std::string(Version())},
       {"data", config.jobs.data.string()},
       {"objects", config.jobs.store.objects},
       {"workers", std::int64_t{JobOptions(config).workers}},
       {"max_waiting", config.jobs.max_waiting},
       {"max_body_bytes", config.max_body_bytes},
       {"max_posts", config.jobs.runner.max_posts},
       {"worker_memory_bytes", config.jobs.runner.limits.memory_bytes},
       {"max_connections", std::int64_t{config.http.max_connections}}});
}

TermBounds TermsOf(const JobServiceOptions& options) {
  return {options.highest_priority, options.runner.limits.wall_seconds, options.deadline_seconds};
}

void LogMemory(const MemoryPlan& memory) {
  Log(LogLevel::kInfo, "memory",
      {{"jobs_bytes", memory.jobs_bytes},
       {"job_bytes", memory.job_bytes},
       {"probes", std::int64_t{memory.probes}},
       {"probe_bytes", memory.probe_bytes}});
}

void LogKeys(const KeyGate& gate, bool on_loopback) {
  const bool asks = gate.AsksForKeys();
  const bool exposed = !asks && !on_loopback;
  Log(exposed ? LogLevel::kWarning : LogLevel::kInfo,
      asks      ? "keys are asked for"
      : exposed ? "nobody is asked for a key, on an address that others reach"
                : "nobody is asked for a key, on loopback",
      {{"keys", gate.CountKeys()}});
}

// Takes the keys of the configuration that may change while the service runs, and says which others
// have changed.
void Reload(const std::function<Result<LoadedConfig>()>& read, const HostPort& address,
            Config& current, Server& server) {
  const Result<LoadedConfig> loaded = read();
  if (!loaded) {
    Log(LogLevel::kError, "the configuration is not reloaded", {{"error", loaded.error().message}});
    return;
  }
  for (const ConfigKey& key : ConfigKeys()) {
    const ConfigValue value = key.get(loaded->config);
    if (value == key.get(current)) continue;
    if (key.reloads) key.set(current, value);
    Log(key.reloads ? LogLevel::kInfo : LogLevel::kWarning,
        key.reloads ? "a key has changed" : "a key has changed, but for the next start",
        {{"key", key.name}});
  }
  ConfigureLog(current.log);
  server.Reload(HttpOptions(current, address));
}

// Until SIGINT or SIGTERM, which it returns. Tells the service manager, as often as it asks, that
// the threads that answer still do.
int WaitForEnd(Server& server, const std::function<void()>& reload) {
  const std::optional<milliseconds> watchdog = WatchdogInterval();
  const milliseconds pause = watchdog ? *watchdog / 3 : milliseconds(3'600'000);
  for (;;) {
    const std::optional<int> signal = WaitForSignal(pause);
    if (signal && IsStopSignal(*signal)) return *signal;
    if (signal && *signal == SIGHUP) reload();
    if (watchdog && server.Responds(pause)) NotifyManager("WATCHDOG=1");
  }
}

}  // namespace

Result<std::shared_ptr<KeyGate>> OpenKeyGate(const Config& config, const HostPort& address) {
  return KeyGate::Open(config.auth, config.jobs.data, IsLoopback(address.host));
}

int ServeProcess(ServeRole role, const LoadedConfig& loaded,
                 const std::function<Result<LoadedConfig>()>& reload) {
  if (Status there = CheckReferenceData(); !there) return ReportError(there.error());
  Config config = loaded.config;
  const Result<HostPort> address = ReadHostPort(config.listen);
  if (!address) return ReportError(address.error());
  ::umask(077);           // nothing of the data is for other users
  BlockServiceSignals();  // before any thread is started, so that all of them block
  ConfigureLog(config.log);
  const BackgroundLog log;
  Result<std::shared_ptr<const AssetFolder>> cesium =
      role == ServeRole::kWork ? std::shared_ptr<const AssetFolder>() : ReadCesium(config);
  if (!cesium) return ReportError(cesium.error());
  const Result<std::shared_ptr<KeyGate>> gate = OpenKeyGate(config, *address);
  if (!gate) return ReportError(gate.error());
  const Result<std::shared_ptr<Fetcher>> fetcher = MakeFetcher(config);
  if (!fetcher) return ReportError(fetcher.error());
  Result<std::shared_ptr<const CallbackRules>> callbacks =
      role == ServeRole::kWork ? std::shared_ptr<const CallbackRules>()
                               : CallbackRules::Make(config.callbacks);
  if (!callbacks) return ReportError(callbacks.error());
  // The port first: a process that cannot bind it must not change the data.
  Result<std::unique_ptr<Server>> server = Server::Bind(HttpOptions(config, *address));
  if (!server) return ReportError(server.error());
  JobServiceOptions options = JobOptions(config);
  if (Status started = StartSpawner(config, options); !started) return ReportError(started.error());
  Result<std::unique_ptr<JobService>> jobs = JobService::Open(options);
  if (!jobs) return ReportError(jobs.error());
  (*jobs)->MarkEnd();
  const std::string base = BaseUrl(config, *address, (*server)->port());
  const HandlerContext context{**jobs,
                               base,
                               config.max_body_bytes,
                               TermsOf(options),
                               *std::move(cesium),
                               config.echo,
                               *gate,
                               *fetcher,
                               *callbacks};
  const Router router =
      role == ServeRole::kWork ? BuildHealthRouter(context) : BuildRouter(context);
  (*server)->Serve(router, **gate);
  std::optional<CallbackSender> sender;
  if (*callbacks) sender.emplace(context, config.callbacks);
  LogStart(role, loaded, base, (*server)->port());
  LogMemory((*jobs)->Memory());
  LogKeys(**gate, IsLoopback(address->host));
  NotifyManager("READY=1");
  const int signal = WaitForEnd(**server, [&] { Reload(reload, *address, config, **server); });
  NotifyManager("STOPPING=1");
  Log(LogLevel::kInfo, "stopping", {{"signal", std::int64_t{signal}}});
  Drain(**jobs, config.drain_time);
  if (*fetcher) (*fetcher)->Stop();
  if (sender) sender->Stop();
  (*server)->Stop(kSendTimeout);
  (*jobs)->Stop();
  Log(LogLevel::kInfo, "stopped", {});
  return kExitDone;
}

}  // namespace farhorizon
