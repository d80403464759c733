#include "service/log.h"

#include <atomic>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "service/clock.h"
#include "service/line_writer.h"

namespace farhorizon {

namespace {

std::atomic<LogLevel> least_level{LogLevel::kInfo};
std::atomic<bool> as_json{true};
std::atomic<LineWriter*> background{nullptr};

// Some 4,000 lines: what a burst of requests says while the reader catches up.
constexpr std::size_t kKeptBytes = std::size_t{1} << 20U;

const char* NameOf(LogLevel level) { return kLogLevelNames.at(static_cast<std::size_t>(level)); }

std::string Escaped(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

nlohmann::json ValueOf(const LogField& field) {
  return std::visit([](const auto& value) { return nlohmann::json(value); }, field.second);
}

std::string LineOf(LogLevel level, std::string_view message, std::span<const LogField> fields) {
  const std::string now = FormatTime(NowMs());
  std::string line;
  if (as_json) {
    nlohmann::ordered_json object = {
        {"ts", now}, {"level", NameOf(level)}, {"msg", std::string(message)}};
    for (const LogField& field : fields) object[std::string(field.first)] = ValueOf(field);
    line = object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  } else {
    line.append(now).append(" ").append(NameOf(level)).append(" ").append(message);
    for (const LogField& field : fields) {
      line.append(" ").append(field.first).append("=").append(Escaped(ValueOf(field)));
    }
  }
  line += '\n';
  return line;
}

}  // namespace

void ConfigureLog(const LogOptions& options) {
  least_level = options.level;
  as_json = options.format == LogFormat::kJson ||
            (options.format == LogFormat::kAuto && ::isatty(STDERR_FILENO) == 0);
}

BackgroundLog::BackgroundLog()
    : writer_(std::make_unique<LineWriter>(STDERR_FILENO, kKeptBytes, [](std::int64_t count) {
        const LogField lines("lines", count);
        return LineOf(LogLevel::kWarning, "lines of the log were lost: nobody reads it",
                      std::span(&lines, 1));
      })) {
  background = writer_.get();
}

BackgroundLog::~BackgroundLog() { background = nullptr; }

std::int64_t LogLinesDropped() {
  const LineWriter* writer = background;
  return writer == nullptr ? 0 : writer->dropped();
}

void Log(LogLevel level, std::string_view message, std::initializer_list<LogField> fields) {
  Log(level, message, std::span(fields.begin(), fields.size()));
}

void Log(LogLevel level, std::string_view message, std::span<const LogField> fields) {
  if (level < least_level.load()) return;
  std::string line = LineOf(level, message, fields);
  if (LineWriter* writer = background) return writer->Write(std::move(line));
  // A log that cannot be written must not stop the work.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace farhorizon
