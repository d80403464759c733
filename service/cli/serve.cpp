#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <thread>

#include "core/pipeline/version.h"
#include "service/cli/command.h"
#include "service/cli/signals.h"
#include "service/config.h"
#include "service/handlers/routes.h"
#include "service/http/server.h"
#include "service/jobs/job_service.h"
#include "service/log.h"

namespace farhorizon {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kBetweenLooks{100};
constexpr milliseconds kLastAnswers{3000};

struct Call {
  std::string config;
  bool print_config = false;
  std::map<std::string, std::string> flags;
};

JobServiceOptions JobOptions(const Config& config) {
  JobServiceOptions options;
  options.data = config.data;
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.engine.workers = config.workers > 0 ? static_cast<int>(config.workers) : cores;
  options.engine.worker_program = config.worker_program;
  options.engine.max_posts = config.jobs_max_posts;
  options.engine.threads_per_worker = static_cast<int>(config.worker_threads);
  options.engine.limits = {config.worker_memory_bytes, config.worker_cpu_seconds,
                           config.worker_wall_seconds, config.worker_file_bytes};
  options.probe_limits = {config.probe_memory_bytes, config.probe_wall_seconds,
                          config.probe_wall_seconds, std::int64_t{1} << 20U};
  options.probe_max_bytes = config.probe_max_bytes;
  options.max_waiting = config.jobs_max_waiting;
  options.min_free_bytes = config.jobs_min_free_bytes;
  return options;
}

ServerOptions HttpOptions(const Config& config, const HostPort& address) {
  ServerOptions options;
  options.host = address.host;
  options.port = address.port;
  options.io_threads = static_cast<int>(config.http_io_threads);
  options.handler_threads = static_cast<int>(config.http_handler_threads);
  options.max_head_bytes = static_cast<std::size_t>(config.http_max_head_bytes);
  options.head_time = seconds(config.http_head_seconds);
  options.idle_time = seconds(config.http_idle_seconds);
  options.body_grace = seconds(config.http_body_grace_seconds);
  options.body_bytes_per_second = config.http_body_bytes_per_second;
  options.write_time = seconds(config.http_write_seconds);
  options.max_connections = static_cast<int>(config.http_max_connections);
  options.max_connections_per_address = static_cast<int>(config.http_max_connections_per_address);
  options.cors_origin = config.http_cors_origin;
  return options;
}

void StartLog(const Config& config) {
  static const std::map<std::string, LogLevel> levels = {{"debug", LogLevel::kDebug},
                                                         {"info", LogLevel::kInfo},
                                                         {"warning", LogLevel::kWarning},
                                                         {"error", LogLevel::kError}};
  static const std::map<std::string, LogFormat> formats = {
      {"auto", LogFormat::kAuto}, {"text", LogFormat::kText}, {"json", LogFormat::kJson}};
  ConfigureLog(levels.at(config.log_level), formats.at(config.log_format));
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

/// Lets running jobs end for their time; a second signal cuts it short.
void Drain(JobService& jobs, seconds most) {
  const auto deadline = std::chrono::steady_clock::now() + most;
  jobs.Drain();
  while (std::chrono::steady_clock::now() < deadline) {
    if (jobs.WaitIdle(kBetweenLooks)) break;
    if (NextSignal(milliseconds(0))) break;
  }
}

int Serve(const Config& config) {
  Result<HostPort> address = ReadHostPort(config.listen);
  if (!address) return Complain(address.error());
  HoldSignals();  // before any thread is started
  StartLog(config);
  // The port first: who cannot have it must not touch the data.
  Result<std::unique_ptr<Server>> server = Server::Bind(HttpOptions(config, *address));
  if (!server) return Complain(server.error());
  Result<std::unique_ptr<JobService>> jobs = JobService::Open(JobOptions(config));
  if (!jobs) return Complain(jobs.error());
  const std::string base = BaseUrl(config, *address, (*server)->port());
  const Router router = BuildRouter({**jobs, base, config.http_max_body_bytes});
  (*server)->Serve(router);
  Log(LogLevel::kInfo, "serving",
      {{"url", base},
       {"port", std::int64_t{(*server)->port()}},
       {"version", std::string(Version())},
       {"data", config.data}});
  std::optional<int> signal;
  while (!signal) signal = NextSignal(milliseconds(3'600'000));
  Log(LogLevel::kInfo, "stopping", {{"signal", std::int64_t{*signal}}});
  Drain(**jobs, seconds(config.jobs_drain_seconds));
  (*server)->Stop(kLastAnswers);
  (*jobs)->Stop();
  Log(LogLevel::kInfo, "stopped", {});
  return kExitDone;
}

int Run(const Call& call) {
  std::optional<std::filesystem::path> file;
  if (!call.config.empty()) file = call.config;
  Result<LoadedConfig> loaded = LoadConfig(file, OurEnvironment(), call.flags);
  if (!loaded) return Complain(loaded.error());
  if (!call.print_config) return Serve(loaded->config);
  std::fputs(WriteConfig(loaded->config).c_str(), stdout);
  for (const auto& [name, origin] : loaded->origins) {
    std::fprintf(stderr, "%s: from %s\n", name.c_str(), origin.c_str());
  }
  return kExitDone;
}

/// Every key with its variable, its meaning and its default.
std::string KeyTable() {
  const Config defaults;
  std::string table =
      "Keys of the configuration. Flags come before environment variables, these before the file,\n"
      "and that before the defaults; config/default.json has them all.\n";
  for (const ConfigKey& key : ConfigKeys()) {
    std::string value;
    if (const auto* text = std::get_if<std::string Config::*>(&key.field)) {
      value = "\"" + defaults.**text + "\"";
    } else {
      value = std::to_string(defaults.*std::get<std::int64_t Config::*>(key.field));
    }
    table +=
        "\n  " + key.name + ", " + key.Environment() + "\n      " + key.help + " (" + value + ")";
  }
  return table;
}

}  // namespace

void AddServe(CLI::App& app, Chosen& chosen) {
  const auto call = std::make_shared<Call>();
  CLI::App* command = app.add_subcommand("serve", "Run the job service");
  command->add_option("--config", call->config, "configuration, a JSON file")->type_name("FILE");
  const auto add = [&](const char* flag, const char* key, const char* type, const char* help) {
    command
        ->add_option_function<std::string>(
            flag, [call, key](const std::string& value) { call->flags[key] = value; }, help)
        ->type_name(type);
  };
  add("--listen", "listen", "HOST:PORT", "address to listen on (127.0.0.1:8080)");
  add("--data", "data", "DIR", "folder for jobs, uploads and artifacts (farhorizon-data)");
  add("--workers", "workers", "N", "jobs at once (as many as there are cores)");
  command->add_flag("--print-config", call->print_config,
                    "print the configuration that would be used, and stop");
  command->footer(KeyTable());
  command->callback([call, &chosen] { chosen = [call] { return Run(*call); }; });
}

}  // namespace farhorizon
