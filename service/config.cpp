#include "service/config.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <string_view>
#include <unistd.h>

#include <nlohmann/json.hpp>

namespace farhorizon {

namespace {

using nlohmann::ordered_json;

constexpr std::string_view kPrefix = "FARHORIZON_";
constexpr std::int64_t kDay = 86400;
constexpr std::int64_t kTebibyte = std::int64_t{1} << 40U;

ConfigKey Text(std::string name, std::string Config::*field, std::string help,
               std::vector<std::string> choices = {}) {
  return {std::move(name), field, std::move(help), 0, 0, std::move(choices)};
}

ConfigKey Number(std::string name, std::int64_t Config::*field, std::int64_t least,
                 std::int64_t most, std::string help) {
  return {std::move(name), field, std::move(help), least, most, {}};
}

std::vector<ConfigKey> HttpKeys() {
  return {
      Number("http.ioThreads", &Config::http_io_threads, 1, 64, "threads that move bytes"),
      Number("http.handlerThreads", &Config::http_handler_threads, 1, 256,
             "threads that answer requests"),
      Number("http.maxBodyBytes", &Config::http_max_body_bytes, 1, kTebibyte,
             "largest upload taken; larger ones get 413"),
      Number("http.maxHeadBytes", &Config::http_max_head_bytes, 1024, 1 << 20,
             "largest request head taken; larger ones get 431"),
      Number("http.headSeconds", &Config::http_head_seconds, 1, kDay,
             "time for a request's head to come in"),
      Number("http.idleSeconds", &Config::http_idle_seconds, 1, kDay,
             "time that a connection may wait between requests"),
      Number("http.bodyGraceSeconds", &Config::http_body_grace_seconds, 1, kDay,
             "time before the least rate of a body counts"),
      Number("http.bodyBytesPerSecond", &Config::http_body_bytes_per_second, 1, kTebibyte,
             "least rate of a body"),
      Number("http.writeSeconds", &Config::http_write_seconds, 1, kDay,
             "time for a client to take each 64 KiB of an answer"),
      Number("http.maxConnections", &Config::http_max_connections, 1, 1'000'000,
             "connections at once; more get 503"),
      Number("http.maxConnectionsPerAddress", &Config::http_max_connections_per_address, 1,
             1'000'000, "connections at once from one address"),
      Text("http.corsOrigin", &Config::http_cors_origin,
           "web pages of which origin may read answers: * for all, empty for none"),
  };
}

std::vector<ConfigKey> WorkKeys() {
  return {
      Number("jobs.maxWaiting", &Config::jobs_max_waiting, 1, 1'000'000,
             "jobs that may wait; more are refused with 503"),
      Number("jobs.maxPosts", &Config::jobs_max_posts, 4, 1'000'000'000,
             "largest DEM taken, in posts; larger ones get 413"),
      Number("jobs.minFreeBytes", &Config::jobs_min_free_bytes, 0, kTebibyte,
             "room on the disk below which uploads are refused with 507"),
      Number("jobs.drainSeconds", &Config::jobs_drain_seconds, 0, kDay,
             "time that running jobs get to end when the service is stopped"),
      Text("worker.program", &Config::worker_program,
           "the program that does a job's work: this one"),
      Number("worker.threads", &Config::worker_threads, 1, 1024, "threads of each worker"),
      Number("worker.memoryBytes", &Config::worker_memory_bytes, 1 << 28, kTebibyte,
             "address space of a worker"),
      Number("worker.wallSeconds", &Config::worker_wall_seconds, 1, 30 * kDay,
             "time that a job may take"),
      Number("worker.cpuSeconds", &Config::worker_cpu_seconds, 1, 30 * kDay,
             "processor time that a job may take, of all threads together"),
      Number("worker.fileBytes", &Config::worker_file_bytes, 1 << 20, kTebibyte,
             "largest file that a worker may write"),
      Number("probe.maxBytes", &Config::probe_max_bytes, 0, kTebibyte,
             "largest upload that is read before its 201; larger ones are read by their job"),
      Number("probe.memoryBytes", &Config::probe_memory_bytes, 1 << 28, kTebibyte,
             "address space of that reading"),
      Number("probe.wallSeconds", &Config::probe_wall_seconds, 1, 3600, "time for that reading"),
  };
}

std::vector<ConfigKey> AllKeys() {
  std::vector<ConfigKey> keys = {
      Text("listen", &Config::listen, "HOST:PORT to listen on; port 0 takes any that is free"),
      Text("data", &Config::data, "the folder for jobs, uploads and artifacts"),
      Text("publicUrl", &Config::public_url,
           "the URL under which clients reach the service; empty: http:// and the address"),
      Number("workers", &Config::workers, 0, 1024, "jobs at once; 0: as many as there are cores"),
  };
  for (std::vector<ConfigKey> section : {HttpKeys(), WorkKeys()}) {
    std::move(section.begin(), section.end(), std::back_inserter(keys));
  }
  keys.push_back(Text("log.level", &Config::log_level, "the least that is logged",
                      {"debug", "info", "warning", "error"}));
  keys.push_back(Text("log.format", &Config::log_format, "auto: text on a terminal, else JSON",
                      {"auto", "text", "json"}));
  return keys;
}

Error Wrong(const ConfigKey& key, const std::string& origin, const std::string& value,
            const std::string& expected) {
  return {ErrorCode::kInvalidArgument,
          key.name + " is \"" + value + "\" (from " + origin + "), expected " + expected,
          "invalid-config"};
}

Status Set(const ConfigKey& key, const std::string& value, const std::string& origin,
           LoadedConfig& loaded) {
  if (const auto* text = std::get_if<std::string Config::*>(&key.field)) {
    if (!key.choices.empty() &&
        std::find(key.choices.begin(), key.choices.end(), value) == key.choices.end()) {
      std::string expected = "one of";
      for (const std::string& choice : key.choices) expected += " " + choice;
      return Wrong(key, origin, value, expected);
    }
    loaded.config.** text = value;
  } else {
    std::int64_t number = 0;
    const char* end = value.data() + value.size();
    const auto [stop, failure] = std::from_chars(value.data(), end, number);
    if (failure != std::errc() || stop != end || number < key.least || number > key.most) {
      return Wrong(
          key, origin, value,
          "a number from " + std::to_string(key.least) + " to " + std::to_string(key.most));
    }
    loaded.config.*std::get<std::int64_t Config::*>(key.field) = number;
  }
  loaded.origins[key.name] = origin;
  return Done{};
}

const ConfigKey* FindKey(const std::string& name) {
  for (const ConfigKey& key : ConfigKeys()) {
    if (key.name == name) return &key;
  }
  return nullptr;
}

Error Unknown(const std::string& what, const std::string& origin) {
  return {ErrorCode::kInvalidArgument,
          "there is no " + what + " (from " + origin + "); farhorizon serve --help lists all keys",
          "unknown-config"};
}

/// Sets every leaf of a section of the file.
Status SetSection(const nlohmann::json& section, const std::string& prefix,
                  const std::string& origin, LoadedConfig& loaded) {
  for (const auto& [name, value] : section.items()) {
    const std::string full = prefix + name;
    if (value.is_object() && prefix.empty()) {
      Status set = SetSection(value, full + ".", origin, loaded);
      if (!set) return set;
      continue;
    }
    const ConfigKey* key = FindKey(full);
    if (key == nullptr) return Unknown("key " + full, origin);
    const bool wants_text = std::holds_alternative<std::string Config::*>(key->field);
    if (wants_text ? !value.is_string() : !value.is_number_integer()) {
      return Wrong(*key, origin, value.dump(), wants_text ? "a text" : "a whole number");
    }
    Status set = Set(*key, wants_text ? value.get<std::string>() : value.dump(), origin, loaded);
    if (!set) return set;
  }
  return Done{};
}

Status LoadFile(const std::filesystem::path& path, LoadedConfig& loaded) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return Error{ErrorCode::kNotFound, "cannot read the configuration " + path.string(),
                 "no-config"};
  }
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  if (!document.is_object()) {
    return Error{ErrorCode::kInvalidArgument, path.string() + " is no JSON object",
                 "invalid-config"};
  }
  return SetSection(document, "", path.string(), loaded);
}

}  // namespace

std::string ConfigKey::Environment() const {
  std::string variable(kPrefix);
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') variable += '_';
    variable += c == '.' ? '_' : c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return variable;
}

const std::vector<ConfigKey>& ConfigKeys() {
  static const std::vector<ConfigKey> keys = AllKeys();
  return keys;
}

Result<LoadedConfig> LoadConfig(const std::optional<std::filesystem::path>& file,
                                const std::map<std::string, std::string>& environment,
                                const std::map<std::string, std::string>& flags) {
  LoadedConfig loaded;
  if (file) {
    Status read = LoadFile(*file, loaded);
    if (!read) return std::move(read.error());
  }
  for (const auto& [variable, value] : environment) {
    const auto& keys = ConfigKeys();
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const ConfigKey& candidate) {
      return candidate.Environment() == variable;
    });
    if (key == keys.end()) return Unknown("variable " + variable, "the environment");
    Status set = Set(*key, value, variable, loaded);
    if (!set) return std::move(set.error());
  }
  for (const auto& [name, value] : flags) {
    const ConfigKey* key = FindKey(name);
    Check(key != nullptr, "a flag names a key");
    Status set = Set(*key, value, "the command line", loaded);
    if (!set) return std::move(set.error());
  }
  return loaded;
}

std::map<std::string, std::string> OurEnvironment() {
  std::map<std::string, std::string> ours;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (text.substr(0, kPrefix.size()) != kPrefix) continue;
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) continue;
    ours.emplace(text.substr(0, equals), text.substr(equals + 1));
  }
  return ours;
}

std::string WriteConfig(const Config& config) {
  ordered_json document = ordered_json::object();
  for (const ConfigKey& key : ConfigKeys()) {
    const std::size_t dot = key.name.find('.');
    ordered_json& section = dot == std::string::npos ? document : document[key.name.substr(0, dot)];
    const std::string leaf = dot == std::string::npos ? key.name : key.name.substr(dot + 1);
    std::visit([&](auto field) { section[leaf] = config.*field; }, key.field);
  }
  return document.dump(2) + "\n";
}

}  // namespace farhorizon
