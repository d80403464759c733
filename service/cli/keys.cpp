#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <sys/stat.h>
#include <utility>
#include <vector>

#include "service/auth/api_key.h"
#include "service/auth/key_file.h"
#include "service/auth/scope.h"
#include "service/cli/command.h"
#include "service/clock.h"
#include "service/config/load_config.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kDayMs = std::int64_t{86400} * 1000;
constexpr int kMostDays = 36'500;

struct KeysArguments {
  std::string data;
  std::string file;
  std::string name;
  std::string scopes = "submit,read,delete";
  std::string of;
  int days = 0;
  std::string id;
};

// Where the keys of the service are: as it finds them itself, by its environment.
Result<fs::path> FileOf(const KeysArguments& arguments) {
  if (!arguments.file.empty()) return fs::path(arguments.file);
  const Result<LoadedConfig> loaded = LoadConfig({}, ConfigEnvironment(), {});
  if (!loaded) return loaded.error();
  if (!arguments.data.empty()) return AuthOptions{}.KeysFile(arguments.data);
  return loaded->config.auth.KeysFile(loaded->config.jobs.data);
}

Error NoSuchKey(const std::string& id, const fs::path& file) {
  return {ErrorCode::kNotFound,
          "there is no key " + id + " in " + file.string() + "; farhorizon keys list shows all",
          "no-such-key"};
}

std::vector<ApiKey>::iterator FindKey(std::vector<ApiKey>& keys, const std::string& id) {
  return std::find_if(keys.begin(), keys.end(), [&](const ApiKey& key) { return key.id == id; });
}

int Add(const KeysArguments& arguments) {
  const Result<fs::path> file = FileOf(arguments);
  if (!file) return ReportError(file.error());
  const Status named = CheckKeyName(arguments.name);
  if (!named) return ReportError(named.error());
  const Result<Scopes> scopes = ReadScopes(arguments.scopes);
  if (!scopes) return ReportError(scopes.error());
  const std::int64_t now_ms = NowMs();
  NewKey made = MakeKey(arguments.name, *scopes, now_ms);
  if (arguments.days > 0) made.key.expires_ms = now_ms + arguments.days * kDayMs;
  const Status added = ChangeKeys(*file, [&](std::vector<ApiKey>& keys) -> Status {
    if (!arguments.of.empty()) {
      const auto first = FindKey(keys, arguments.of);
      if (first == keys.end()) return NoSuchKey(arguments.of, *file);
      made.key.owner = first->owner;
    }
    // One of 2^48: it is not to be another's.
    while (FindKey(keys, made.key.id) != keys.end()) {
      NewKey again = MakeKey(made.key.name, made.key.scopes, now_ms);
      if (made.key.owner != made.key.id) again.key.owner = made.key.owner;
      again.key.expires_ms = made.key.expires_ms;
      made = std::move(again);
    }
    keys.push_back(made.key);
    return Ok{};
  });
  if (!added) return ReportError(added.error());
  std::printf("%s\n", made.text.c_str());
  std::fprintf(stderr,
               "farhorizon: this is key %s; it is shown this once and cannot be told again\n",
               made.key.id.c_str());
  return kExitDone;
}

const char* StateOf(const ApiKey& key, std::int64_t now_ms) {
  return key.revoked_ms ? "revoked" : key.IsLive(now_ms) ? "good" : "expired";
}

std::string DayOf(const std::optional<std::int64_t>& time_ms) {
  return time_ms ? FormatTime(*time_ms).substr(0, 10) : "-";
}

int List(const KeysArguments& arguments) {
  const Result<fs::path> file = FileOf(arguments);
  if (!file) return ReportError(file.error());
  const Result<std::vector<ApiKey>> keys = ReadKeys(*file);
  if (!keys && keys.error().code != ErrorCode::kNotFound) return ReportError(keys.error());
  std::printf("%-12s  %-7s  %-18s  %-10s  %-10s  %-12s  %s\n", "ID", "STATE", "SCOPES", "CREATED",
              "EXPIRES", "OWNER", "NAME");
  const std::int64_t now_ms = NowMs();
  for (const ApiKey& key : keys ? *keys : std::vector<ApiKey>()) {
    std::string scopes;
    for (const std::string& scope : NamesOf(key.scopes)) {
      scopes += (scopes.empty() ? "" : ",") + scope;
    }
    std::printf("%-12s  %-7s  %-18s  %-10s  %-10s  %-12s  %s\n", key.id.c_str(),
                StateOf(key, now_ms), scopes.c_str(), DayOf(key.created_ms).c_str(),
                DayOf(key.expires_ms).c_str(), key.owner.c_str(), key.name.c_str());
  }
  return kExitDone;
}

int Revoke(const KeysArguments& arguments) {
  const Result<fs::path> file = FileOf(arguments);
  if (!file) return ReportError(file.error());
  return ExitStatusOf(ChangeKeys(*file, [&](std::vector<ApiKey>& keys) -> Status {
    const auto key = FindKey(keys, arguments.id);
    if (key == keys.end()) return NoSuchKey(arguments.id, *file);
    if (!key->revoked_ms) key->revoked_ms = NowMs();
    return Ok{};
  }));
}

void AddPlace(Command& command, KeysArguments& arguments) {
  command.Add({.names = "--data",
               .type = "DIR",
               .help = "the data folder of the service (FARHORIZON_DATA, or farhorizon-data)"},
              arguments.data);
  command.Add({.names = "--file",
               .type = "FILE",
               .help = "the file of keys (FARHORIZON_AUTH_KEYS_FILE, or keys.json in that folder)"},
              arguments.file);
}

}  // namespace

void AddKeys(Command& program, SelectedCommand& selected) {
  const auto arguments = std::make_shared<KeysArguments>();
  Command keys = program.AddCommand("keys", "Keys of a service: make, show and revoke them");
  keys.SetFooter(
      "The service may run: it knows a new key, and no longer one that was revoked, from its next\n"
      "request on. The service keeps hashes of keys; the text of a key is shown once, by add.");
  const auto select = [&](Command& command, int (*run)(const KeysArguments&)) {
    AddPlace(command, *arguments);
    command.Select(selected, [arguments, run] {
      ::umask(077);
      return run(*arguments);
    });
  };
  Command add = keys.AddCommand("add", "Make a key and print it");
  add.Add({.names = "--name", .type = "TEXT", .help = "whose it is, or what for", .required = true},
          arguments->name);
  add.Add(
      {.names = "--scopes",
       .type = "LIST",
       .help = "of submit, read, delete, admin (submit,read,delete). Each key sees its own jobs; "
               "one with admin may do and see all"},
      arguments->scopes);
  add.Add({.names = "--days", .type = "N", .help = "days that it is good for, 0 without end (0)"},
          arguments->days, 0, kMostDays);
  add.Add(
      {.names = "--of",
       .type = "ID",
       .help = "a further key of that one's owner: it sees the same jobs and shares the limits, "
               "so that a key can be replaced"},
      arguments->of);
  select(add, Add);
  Command list = keys.AddCommand("list", "Show all keys, but their texts");
  select(list, List);
  Command revoke = keys.AddCommand("revoke", "End a key at once; its jobs stay");
  revoke.Add({.names = "ID", .type = "", .help = "of the key", .required = true}, arguments->id);
  select(revoke, Revoke);
}

}  // namespace farhorizon
