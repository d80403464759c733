#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// How the service runs. Every field is a key, documented once in ConfigKeys; the defaults here are
/// those of config/default.json.
struct Config {
  std::string listen = "127.0.0.1:8080";
  std::string data = "farhorizon-data";
  std::string public_url;
  std::int64_t workers = 0;

  std::int64_t http_io_threads = 2;
  std::int64_t http_handler_threads = 8;
  std::int64_t http_max_body_bytes = std::int64_t{1} << 31U;
  std::int64_t http_max_head_bytes = 16384;
  std::int64_t http_head_seconds = 10;
  std::int64_t http_idle_seconds = 60;
  std::int64_t http_body_grace_seconds = 20;
  std::int64_t http_body_bytes_per_second = 1024;
  std::int64_t http_write_seconds = 30;
  std::int64_t http_max_connections = 1024;
  std::int64_t http_max_connections_per_address = 256;
  std::string http_cors_origin = "*";

  std::int64_t jobs_max_waiting = 1000;
  std::int64_t jobs_max_posts = 64'000'000;
  std::int64_t jobs_min_free_bytes = std::int64_t{1} << 28U;
  std::int64_t jobs_drain_seconds = 30;

  std::string worker_program = "/proc/self/exe";
  std::int64_t worker_threads = 1;
  std::int64_t worker_memory_bytes = std::int64_t{1} << 32U;
  std::int64_t worker_wall_seconds = 3600;
  std::int64_t worker_cpu_seconds = 3600;
  std::int64_t worker_file_bytes = std::int64_t{1} << 33U;

  std::int64_t probe_max_bytes = std::int64_t{1} << 26U;
  std::int64_t probe_memory_bytes = std::int64_t{1} << 31U;
  std::int64_t probe_wall_seconds = 20;

  std::string log_level = "info";
  std::string log_format = "auto";
};

/// One key of the configuration.
struct ConfigKey {
  std::string name;  ///< "http.maxBodyBytes": a section and a key of the file
  std::variant<std::string Config::*, std::int64_t Config::*> field;
  std::string help;
  std::int64_t least = 0;  ///< of numbers
  std::int64_t most = 0;
  std::vector<std::string> choices = {};  ///< of texts; empty: any

  /// "FARHORIZON_HTTP_MAX_BODY_BYTES".
  [[nodiscard]] std::string Environment() const;
};

/// Every key, in the order of the file.
const std::vector<ConfigKey>& ConfigKeys();

/// A configuration and where each key that is not at its default came from.
struct LoadedConfig {
  Config config;
  std::map<std::string, std::string> origins;
};

/// Flags before environment before file before defaults.
///
/// flags: by key name. environment: every FARHORIZON_… variable there is.
/// Errors: kInvalidArgument, naming key, origin, value and what is expected; a key, or a variable of
///   ours, that there is not; kNotFound, kIo where the file cannot be read.
Result<LoadedConfig> LoadConfig(const std::optional<std::filesystem::path>& file,
                                const std::map<std::string, std::string>& environment,
                                const std::map<std::string, std::string>& flags);

/// The variables of this process whose names start with FARHORIZON_.
std::map<std::string, std::string> OurEnvironment();

/// As config/default.json has it: a JSON object of sections.
std::string WriteConfig(const Config& config);

}  // namespace farhorizon
