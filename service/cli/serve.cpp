#include <cstdio>
#include <map>
#include <memory>

#include "service/cli/command.h"
#include "service/cli/serve_process.h"
#include "service/config/config.h"
#include "service/config/config_keys.h"
#include "service/config/load_config.h"
#include "service/http/trusted_proxies.h"

namespace farhorizon {

namespace {

struct ServeArguments {
  ServeRole role = ServeRole::kServe;
  std::string config_file;
  bool print_config = false;
  bool check_config = false;
  std::map<std::string, std::string> flags;
};

void PrintNotes(const LoadedConfig& loaded) {
  for (const auto& [name, origin] : loaded.origins) {
    std::fprintf(stderr, "%s: from %s\n", name.c_str(), origin.c_str());
  }
  for (const std::string& variable : loaded.ignored) {
    std::fprintf(stderr, "%s: names no key, ignored\n", variable.c_str());
  }
}

int Run(const ServeArguments& arguments) {
  std::optional<std::filesystem::path> file;
  if (!arguments.config_file.empty()) file = arguments.config_file;
  const auto load = [&] { return LoadConfig(file, ConfigEnvironment(), arguments.flags); };
  const Result<LoadedConfig> loaded = load();
  if (!loaded) return ReportError(loaded.error());
  const StoreOptions& store = loaded->config.jobs.store;
  const Status fit = CheckStoreOptions(store, loaded->config.jobs.data);
  if (!fit) return ReportError(fit.error());
  if (arguments.role == ServeRole::kWork && store.jobs.empty()) {
    return ReportError({ErrorCode::kInvalidArgument,
                        "there are no jobs to work on but those that a service shares: give "
                        "--database and --objects, as it has them",
                        "invalid-config"});
  }
  if (arguments.check_config) {
    const Result<HostPort> address = ReadHostPort(loaded->config.listen);
    if (!address) return ReportError(address.error());
    const auto proxies = TrustedProxies::Read(loaded->config.http.trusted_proxies);
    if (!proxies) return ReportError(proxies.error());
    const auto gate = OpenKeyGate(loaded->config, *address);
    if (!gate) return ReportError(gate.error());
    const auto fetcher = Fetcher::Make(loaded->config.fetch);
    if (!fetcher) return ReportError(fetcher.error());
    const auto callbacks = CallbackRules::Make(loaded->config.callbacks);
    if (!callbacks) return ReportError(callbacks.error());
  }
  if (!arguments.print_config && !arguments.check_config) {
    return ServeProcess(arguments.role, *loaded, load);
  }
  if (arguments.print_config) std::fputs(WriteConfig(loaded->config).c_str(), stdout);
  PrintNotes(*loaded);
  return kExitDone;
}

// Every key with its variable, its meaning and its default.
std::string KeyTable() {
  const Config defaults;
  std::string table =
      "Keys of the configuration. Flags come before environment variables, these before the file,\n"
      "and that before the defaults; config/default.json has them all. SIGHUP reads them again "
      "and\n"
      "takes those that reload.\n";
  for (const ConfigKey& key : ConfigKeys()) {
    const ConfigValue value = key.get(defaults);
    const std::string text = key.IsText() ? "\"" + std::get<std::string>(value) + "\""
                                          : std::to_string(std::get<std::int64_t>(value));
    table += "\n  " + key.name + ", " + key.Environment() + (key.reloads ? ", reloads" : "") +
             "\n      " + key.help + " (" + text + ")";
  }
  return table;
}

void AddRole(ServeRole role, const char* name, const char* help, Command& program,
             SelectedCommand& selected) {
  const auto arguments = std::make_shared<ServeArguments>();
  arguments->role = role;
  Command command = program.AddCommand(name, help);
  command.Add({.names = "--config", .type = "FILE", .help = "configuration, a JSON file"},
              arguments->config_file);
  const auto add = [&](const char* flag, const char* key, const char* type, const char* meaning) {
    command.Add({.names = flag, .type = type, .help = meaning},
                [arguments, key](const std::string& value) { arguments->flags[key] = value; });
  };
  add("--listen", "listen", "HOST:PORT", "address to listen on (127.0.0.1:8080)");
  add("--data", "data", "DIR", "folder for jobs, uploads and artifacts (farhorizon-data)");
  add("--database", "store.jobs", "URL", "PostgreSQL database for jobs that services share");
  add("--objects", "store.objects", "DIR|URL",
      "folder, or s3://BUCKET/PREFIX, for uploads and artifacts that they share");
  add("--workers", "workers", "N", "jobs at once (as many as there are cores)");
  command.AddSwitch("--print-config", "print the configuration that would be used, and stop",
                    arguments->print_config);
  command.AddSwitch("--check-config",
                    "check the configuration, say where its values are from, and stop",
                    arguments->check_config);
  command.SetFooter(KeyTable());
  command.Select(selected, [arguments] { return Run(*arguments); });
}

}  // namespace

void AddServe(Command& program, SelectedCommand& selected) {
  AddRole(ServeRole::kServe, "serve", "Run the job service", program, selected);
}

void AddWork(Command& program, SelectedCommand& selected) {
  AddRole(ServeRole::kWork, "work", "Run jobs of services that share a database; answer none",
          program, selected);
}

}  // namespace farhorizon
