#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/config/config.h"

namespace farhorizon {

/// A configuration and, by name of the key, the source of each value that was set.
struct LoadedConfig {
  Config config;
  std::map<std::string, std::string> origins;
  /// Variables of the environment that name no key. Kubernetes makes such of each service's name,
  /// FARHORIZON_PORT among them.
  std::vector<std::string> ignored;
};

/// Sets the keys from flags, environment and file; a key that is in several of them gets its value
/// from the first, one that is in none keeps its default.
///
/// flags: by key name. environment: all variables that start with kEnvironmentPrefix.
/// Errors: kInvalidArgument for a value, with key, origin, value and the expected values, and for
///   an unknown key of the file; kNotFound where the file cannot be read.
Result<LoadedConfig> LoadConfig(const std::optional<std::filesystem::path>& file,
                                const std::map<std::string, std::string>& environment,
                                const std::map<std::string, std::string>& flags);

/// The environment variables of this process that start with kEnvironmentPrefix.
std::map<std::string, std::string> ConfigEnvironment();

}  // namespace farhorizon
