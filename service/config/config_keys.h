#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "service/config/config.h"

namespace farhorizon {

/// A value as it stands in the file, on the command line or in the environment.
using ConfigValue = std::variant<std::string, std::int64_t>;

/// One key of the configuration.
struct ConfigKey {
  std::string name;  ///< "http.maxBodyBytes": a section and a key of the file
  std::string help;
  std::int64_t least = 0;  ///< of numbers
  std::int64_t most = 0;
  std::vector<std::string> choices;  ///< of texts; empty: any
  std::function<ConfigValue(const Config&)> get;
  /// Requires: a value of the same type as that of `get`, within the limits or of the choices.
  std::function<void(Config&, const ConfigValue&)> set;

  bool reloads = false;  ///< whether a running service takes a new value at SIGHUP

  /// True if the key's values are texts, false if they are numbers.
  [[nodiscard]] bool IsText() const;
  /// "FARHORIZON_HTTP_MAX_BODY_BYTES".
  [[nodiscard]] std::string Environment() const;
};

/// What the name of every environment variable of the configuration starts with.
constexpr const char* kEnvironmentPrefix = "FARHORIZON_";

/// Every key, in the order of the file.
const std::vector<ConfigKey>& ConfigKeys();

/// The file that has this configuration: a JSON object of sections, as config/default.json.
std::string WriteConfig(const Config& config);

}  // namespace farhorizon
