#pragma once

#include <array>
#include <filesystem>

#include "service/auth/key_meter.h"

namespace farhorizon {

/// When keys are asked for. kAuto: where the service listens on another address than loopback, and
/// where a file of keys is or was there.
enum class AuthRequired { kAuto, kAlways, kNever };
inline constexpr std::array kAuthRequiredNames = {"auto", "always", "never"};

/// Who may read /metrics where keys are asked for: a key with the scope admin, or everybody.
enum class MetricsFor { kAdmin, kEveryone };
inline constexpr std::array kMetricsForNames = {"admin", "everyone"};

struct AuthOptions {
  AuthRequired required = AuthRequired::kAuto;
  std::filesystem::path keys_file = {};  ///< empty: keys.json in the data folder
  MetricsFor metrics = MetricsFor::kAdmin;
  MeterBounds bounds = {};

  [[nodiscard]] std::filesystem::path KeysFile(const std::filesystem::path& data) const {
    return keys_file.empty() ? data / "keys.json" : keys_file;
  }
};

}  // namespace farhorizon
