#include "service/jobs/sqlite_rows.h"

#include <nlohmann/json.hpp>

namespace farhorizon {

namespace {

std::optional<Error> ReadFailure(const Statement& row) {
  if (row.IsNull(14)) return std::nullopt;
  const ErrorCode code = ErrorCodeFromName(row.Text(14)).value_or(ErrorCode::kIo);
  // Another version of the program may have written a kind that this one does not know.
  return Error{code, row.Text(16), ErrorKind::FromName(row.Text(15)).value_or(ErrorKind())};
}

std::map<std::string, double> ReadTimings(const std::string& text) {
  std::map<std::string, double> timings;
  const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  for (const auto& [stage, seconds] : document.items()) {
    if (seconds.is_number()) timings[stage] = seconds.get<double>();
  }
  return timings;
}

Assumptions ReadAssumptions(const std::string& text) {
  Assumptions assumptions;
  const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  if (!document.is_array()) return assumptions;
  for (const nlohmann::json& one : document) {
    if (!one.is_object() || !one.contains("code") || !one.contains("text")) continue;
    if (!one["code"].is_string() || !one["text"].is_string()) continue;
    assumptions.push_back({one["code"].get<std::string>(), one["text"].get<std::string>()});
  }
  return assumptions;
}

}  // namespace

std::string AssumptionsColumn(const Assumptions& assumptions) {
  nlohmann::json document = nlohmann::json::array();
  for (const auto& [code, text] : assumptions) {
    document.push_back({{"code", code}, {"text", text}});
  }
  return document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Job ReadJob(const Statement& row) {
  Job job;
  job.id = row.Text(0);
  job.state = JobStateOf(row.Text(1)).value_or(JobState::kFailed);
  job.filename = row.Text(2);
  job.parameters = DecodeQuery(row.Text(3)).value_or(Parameters{});
  job.input_sha256 = row.Text(4);
  job.input_bytes = row.Integer(5);
  job.progress = static_cast<int>(row.Integer(6));
  job.message = row.Text(7);
  job.created_ms = row.Integer(8);
  if (!row.IsNull(9)) job.started_ms = row.Integer(9);
  if (!row.IsNull(10)) job.finished_ms = row.Integer(10);
  job.updated_ms = row.Integer(11);
  job.attempt = row.Integer(12);
  job.crash_count = row.Integer(13);
  job.failure = ReadFailure(row);
  job.timings = ReadTimings(row.Text(17));
  job.assumptions = ReadAssumptions(row.Text(18));
  return job;
}

std::optional<Job> SelectJob(const Database& database, const std::string& id) {
  Statement row(database, std::string("SELECT ") + kJobColumns + " FROM jobs WHERE id = ?");
  row.Bind(id);
  if (!row.Step()) return std::nullopt;
  return ReadJob(row);
}

}  // namespace farhorizon
