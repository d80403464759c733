#include "service/cli/reporter.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

#include <nlohmann/json.hpp>

namespace farhorizon {

namespace {

constexpr int kBarWidth = 40;

}  // namespace

void AddReporterOptions(Command& command, ReporterOptions& options) {
  command.AddChoice({.names = "--progress",
                     .type = "FORM",
                     .help = "auto: a bar on a terminal, nothing on a pipe; json: an object a line "
                             "on stderr; none (auto)"},
                    options.form, {"auto", "json", "none"});
}

Reporter::Reporter(const ReporterOptions& options)
    : bar_(options.form == "auto" && ::isatty(STDERR_FILENO) != 0), json_(options.form == "json") {}

Reporter::~Reporter() { Clear(); }

Progress Reporter::progress(Workflow workflow) {
  if (!bar_ && !json_) return {};
  overall_.emplace(workflow);
  return [this](Stage stage, double done) {
    Show(StageName(stage), done, overall_->Percent(stage, done));
  };
}

WarningHandler Reporter::warn() {
  return [this](const std::string& text) { Print(text, {{"notice", text}}); };
}

AssumptionHandler Reporter::assume() {
  return [this](const Assumption& assumption) {
    Print("assumed: " + assumption.text,
          {{"assumption", {{"code", assumption.code}, {"text", assumption.text}}}});
  };
}

void Reporter::Print(const std::string& text, const nlohmann::json& object) {
  Clear();
  const std::string line =
      json_ ? object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
            : "farhorizon: " + text;
  std::fprintf(stderr, "%s\n", line.c_str());
}

void Reporter::Show(const std::string& stage, double done, int percent) {
  std::string line;
  if (json_) {
    const nlohmann::ordered_json object = {{"stage", stage}, {"done", done}, {"progress", percent}};
    line = object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  } else if (bar_) {
    const auto filled = static_cast<std::size_t>(std::clamp(percent, 0, 100) * kBarWidth / 100);
    line = "\r[" + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "] " +
           std::to_string(percent) + "% " + stage + "\x1b[K";
    drawn_ = true;
  }
  if (line == last_) return;
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  last_ = line;
}

void Reporter::Clear() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
  drawn_ = false;
}

}  // namespace farhorizon
