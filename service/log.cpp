#include "service/log.h"

#include <atomic>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "service/clock.h"

namespace farhorizon {

namespace {

std::atomic<LogLevel> least_level{LogLevel::kInfo};
std::atomic<bool> as_json{true};

const char* NameOf(LogLevel level) { return kLogLevelNames.at(static_cast<std::size_t>(level)); }

std::string Escaped(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

nlohmann::json ValueOf(const LogField& field) {
  return std::visit([](const auto& value) { return nlohmann::json(value); }, field.second);
}

}  // namespace

void ConfigureLog(const LogOptions& options) {
  least_level = options.level;
  as_json = options.format == LogFormat::kJson ||
            (options.format == LogFormat::kAuto && ::isatty(STDERR_FILENO) == 0);
}

void Log(LogLevel level, std::string_view message, std::initializer_list<LogField> fields) {
  if (level < least_level.load()) return;
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
  // A log that cannot be written must not stop the work.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace farhorizon
