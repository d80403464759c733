#include "service/jobs/sql_rows.h"

#include <algorithm>
#include <utility>
#include <variant>

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

// Conditions of a WHERE, each with AND before it, and the values that they compare with.
struct Conditions {
  std::string text;
  std::vector<std::variant<std::string, std::int64_t>> values;

  void Add(const char* condition, std::variant<std::string, std::int64_t> value) {
    text.append(" AND ").append(condition);
    values.push_back(std::move(value));
  }
  // The column has one of these values. Without any, nothing is asked for.
  void AddOneOf(const char* column, const std::vector<std::string>& allowed) {
    if (allowed.empty()) return;
    text.append(" AND ").append(column).append(" IN (?");
    for (std::size_t i = 1; i < allowed.size(); ++i) text.append(", ?");
    text.append(")");
    values.insert(values.end(), allowed.begin(), allowed.end());
  }
};

Conditions ConditionsOf(const JobQuery& query) {
  Conditions all;
  // The second condition is that of the index jobs_by_owner.
  if (query.owner) all.Add("owner = ? AND owner <> ''", *query.owner);
  std::vector<std::string> states;
  for (const JobState state : query.states) states.emplace_back(JobStateName(state));
  if (query.before) all.Add("id < ?", *query.before);
  all.AddOneOf("state", states);
  all.AddOneOf("process", query.processes);
  if (query.created_from_ms) all.Add("created_ms >= ?", *query.created_from_ms);
  if (query.created_to_ms) all.Add("created_ms <= ?", *query.created_to_ms);
  // A job that waits to run again has a start and no end.
  const bool timed = query.least_duration_ms || query.most_duration_ms;
  if (timed) all.text += " AND state <> 'accepted' AND started_ms IS NOT NULL";
  if (query.least_duration_ms) {
    all.Add("(finished_ms IS NULL OR finished_ms - started_ms >= ?)", *query.least_duration_ms);
    all.Add("(finished_ms IS NOT NULL OR started_ms <= ?)",
            query.now_ms - *query.least_duration_ms);
  }
  if (query.most_duration_ms) {
    all.Add("(finished_ms IS NULL OR finished_ms - started_ms <= ?)", *query.most_duration_ms);
    all.Add("(finished_ms IS NOT NULL OR started_ms >= ?)", query.now_ms - *query.most_duration_ms);
  }
  return all;
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
  const std::optional<Parameters> parameters = DecodeQuery(row.Text(3));
  job.parameters = parameters.value_or(Parameters{});
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
  job.client = row.Text(19);
  job.run = row.Integer(20);
  job.retries = row.Integer(21);
  job.priority = static_cast<Priority>(std::clamp<std::int64_t>(row.Integer(22), 0, 2));
  if (!row.IsNull(23)) job.deadline_ms = row.Integer(23);
  job.timeout_seconds = row.Integer(24);
  job.cost = {row.Integer(25), row.Integer(26)};
  job.process = row.Text(27);
  job.answer = row.Text(28);
  job.owner = row.Text(29);
  job.source = row.Text(30);
  const bool unclear = !parameters && !IsTerminal(job.state);
  if (unclear || (job.state == JobState::kFailed && !job.failure)) {
    job.failure =
        Error{ErrorCode::kIo, "the job's row is damaged; submit the DEM again", "job-store"};
  }
  return job;
}

std::optional<Job> SelectJob(const SqlDatabase& database, const std::string& id) {
  Statement row(database, std::string("SELECT ") + kJobColumns + " FROM jobs WHERE id = ?");
  row.Bind(id);
  if (!row.Step()) return std::nullopt;
  return ReadJob(row);
}

std::optional<Job> SelectJobToChange(const SqlDatabase& database, const std::string& id) {
  Statement row(database, std::string("SELECT ") + kJobColumns + " FROM jobs WHERE id = ?" +
                              database.dialect().lock_rows);
  row.Bind(id);
  if (!row.Step()) return std::nullopt;
  return ReadJob(row);
}

JobPage SelectPage(const SqlDatabase& database, const JobQuery& query) {
  const Conditions conditions = ConditionsOf(query);
  Statement rows(database, std::string("SELECT ") + kJobColumns + " FROM jobs WHERE 1 = 1" +
                               conditions.text + " ORDER BY id DESC LIMIT ?");
  for (const auto& value : conditions.values) {
    std::visit([&rows](const auto& one) { rows.Bind(one); }, value);
  }
  rows.Bind(std::int64_t{query.limit} + 1);  // one more tells whether a page follows
  JobPage page;
  while (rows.Step()) page.jobs.push_back(ReadJob(rows));
  if (page.jobs.size() > static_cast<std::size_t>(query.limit)) {
    page.jobs.pop_back();
    page.next = page.jobs.back().id;
  }
  return page;
}

std::string RunningHere(const SqlDatabase& database) {
  const std::string& own = database.dialect().own_runs;
  return own.empty() ? "state = 'running'" : "state = 'running' AND " + own;
}

Statement& BindFailure(Statement& update, const Error& failure, std::int64_t now_ms) {
  update.Bind(failure.message).Bind(std::string(ErrorCodeName(failure.code)));
  return update.Bind(std::string(failure.kind)).Bind(failure.message).Bind(now_ms);
}

UnfinishedJobs CountUnfinishedJobs(const SqlDatabase& database) {
  Statement count(database,
                  "SELECT count(*) FILTER (WHERE state = 'accepted'), "
                  "count(*) FILTER (WHERE state = 'running') "
                  "FROM jobs WHERE state IN ('accepted', 'running')");
  count.Step();
  return {count.Integer(0), count.Integer(1)};
}

std::string InsertJob(const SqlDatabase& database, const NewJob& job, std::int64_t now_ms) {
  Statement newest(database, "SELECT max(id) FROM jobs");
  const std::string last = newest.Step() ? newest.Text(0) : "";
  const std::string id = IsJobId(last) ? NextJobId(now_ms, last) : NewJobId(now_ms);
  Statement insert(database,
                   "INSERT INTO jobs (id, state, filename, parameters, input_sha256, "
                   "input_bytes, created_ms, updated_ms, assumptions, client, message, priority, "
                   "timeout_seconds, cost_memory_bytes, cost_seconds, process, answer, owner, "
                   "source, deadline_ms) "
                   "VALUES (?, 'accepted', ?, ?, ?, ?, ?, ?, ?, ?, 'waiting', ?, ?, ?, ?, ?, ?, ?, "
                   "?, nullif(CAST(? AS BIGINT), 0))");
  insert.Bind(id).Bind(job.filename).Bind(EncodeQuery(job.parameters));
  insert.Bind(job.input_sha256).Bind(job.input_bytes).Bind(now_ms).Bind(now_ms);
  insert.Bind(AssumptionsColumn(job.assumptions)).Bind(job.client);
  const JobTerms& terms = job.terms;
  insert.Bind(static_cast<std::int64_t>(terms.priority)).Bind(terms.timeout_seconds);
  insert.Bind(job.cost.memory_bytes).Bind(job.cost.seconds);
  insert.Bind(job.process).Bind(job.answer).Bind(job.owner).Bind(job.source);
  insert.Bind(terms.deadline_seconds > 0 ? now_ms + terms.deadline_seconds * 1000 : 0).Run();
  return id;
}

StoreIdentity SelectIdentity(const SqlDatabase& database) {
  Statement row(database, "SELECT id, generation FROM store");
  if (!row.Step()) return {};
  return {row.Text(0), row.Integer(1)};
}

std::vector<Artifact> SelectArtifacts(const SqlDatabase& database, const std::string& id) {
  Statement rows(database,
                 "SELECT name, media_type, bytes, sha256, gzip_sha256, gzip_bytes, zstd_sha256, "
                 "zstd_bytes FROM artifacts WHERE job_id = ? ORDER BY name");
  rows.Bind(id);
  std::vector<Artifact> artifacts;
  while (rows.Step()) {
    artifacts.push_back({rows.Text(0), rows.Text(1), rows.Integer(2), rows.Text(3)});
    if (!rows.IsNull(4)) artifacts.back().gzip = StoredObject{rows.Text(4), rows.Integer(5)};
    if (!rows.IsNull(6)) artifacts.back().zstd = StoredObject{rows.Text(6), rows.Integer(7)};
  }
  return artifacts;
}

void InsertArtifact(const SqlDatabase& database, const std::string& id, const Artifact& artifact) {
  std::string columns = "job_id, name, media_type, bytes, sha256";
  std::string values = "?, ?, ?, ?, ?";
  if (artifact.gzip) columns += ", gzip_sha256, gzip_bytes";
  if (artifact.zstd) columns += ", zstd_sha256, zstd_bytes";
  for (const auto* copy : {&artifact.gzip, &artifact.zstd}) {
    if (*copy) values += ", ?, ?";
  }
  Statement insert(database, "INSERT INTO artifacts (" + columns + ") VALUES (" + values + ")");
  insert.Bind(id).Bind(artifact.name).Bind(artifact.media_type);
  insert.Bind(artifact.bytes).Bind(artifact.sha256);
  for (const auto* copy : {&artifact.gzip, &artifact.zstd}) {
    if (*copy) insert.Bind((*copy)->sha256).Bind((*copy)->bytes);
  }
  insert.Run();
}

}  // namespace farhorizon
