#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
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

/// Sets the options of all later calls of Log. Threads: safe.
void ConfigureLog(const LogOptions& options);

/// While this object lives, a thread of its own writes the lines of Log, so that no caller waits
/// for whoever reads them: what a pipe that is not read does not take is dropped, counted and said.
/// One at a time. Requires: no thread calls Log while it is made or destroyed.
class BackgroundLog {
 public:
  BackgroundLog();
  ~BackgroundLog();
  BackgroundLog(const BackgroundLog&) = delete;
  BackgroundLog& operator=(const BackgroundLog&) = delete;

 private:
  std::unique_ptr<class LineWriter> writer_;
};

/// The number of lines that the background log has dropped. Requires: as of Log.
std::int64_t LogLinesDropped();

/// Writes one line to standard error. Text and JSON escape control characters.
/// Threads: safe.
void Log(LogLevel level, std::string_view message, std::span<const LogField> fields);
void Log(LogLevel level, std::string_view message, std::initializer_list<LogField> fields = {});

}  // namespace farhorizon
