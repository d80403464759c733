#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace farhorizon {

enum class LogLevel { kDebug, kInfo, kWarning, kError };
constexpr std::array<const char*, 4> kLogLevelNames = {"debug", "info", "warning", "error"};

/// kAuto: text if standard error is a terminal, else JSON.
enum class LogFormat { kAuto, kText, kJson };
constexpr std::array<const char*, 3> kLogFormatNames = {"auto", "text", "json"};

struct LogOptions {
  LogLevel level = LogLevel::kInfo;  ///< the least that is written
  LogFormat format = LogFormat::kAuto;
};

using LogField = std::pair<std::string_view, std::variant<std::string, std::int64_t>>;

/// Sets the options of all later calls of Log. To be called once, at start.
void ConfigureLog(const LogOptions& options);

/// Writes one line to standard error, in one call of write. Text and JSON escape control
/// characters.
/// Threads: safe.
void Log(LogLevel level, std::string_view message, std::initializer_list<LogField> fields = {});

}  // namespace farhorizon
