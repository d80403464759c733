#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace farhorizon {

enum class LogLevel { kDebug, kInfo, kWarning, kError };
enum class LogFormat { kAuto, kText, kJson };

using LogField = std::pair<std::string_view, std::variant<std::string, std::int64_t>>;

/// Sets what is written and how, once at start. kAuto: text where stderr is a terminal, else JSON.
void ConfigureLog(LogLevel least, LogFormat format);

/// Writes one line to stderr, as one write; control characters are escaped in either form.
/// Threads: safe.
void Log(LogLevel level, std::string_view message, std::initializer_list<LogField> fields = {});

}  // namespace farhorizon
