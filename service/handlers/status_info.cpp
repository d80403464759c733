#include "service/handlers/status_info.h"

#include "service/clock.h"
#include "service/handlers/parameter_names.h"
#include "service/handlers/problem.h"

namespace farhorizon {

namespace {

using nlohmann::ordered_json;

constexpr const char* kRelations = "http://www.opengis.net/def/rel/ogc/1.0/";

ordered_json Link(const std::string& relation, const std::string& href) {
  return {{"rel", relation}, {"type", "application/json"}, {"href", href}};
}

}  // namespace

ordered_json StatusInfo(const Job& job, const std::string& base) {
  const std::string self = base + "/jobs/" + job.id;
  ordered_json info = {{"jobID", job.id},
                       {"id", job.id},
                       {"type", "process"},
                       {"processingEntityType", "ogc-api-processes"},
                       {"processID", job.process},
                       {"status", JobStateName(job.state)},
                       {"message", job.message},
                       {"progress", job.progress},
                       {"created", FormatTime(job.created_ms)}};
  if (job.started_ms) info["started"] = FormatTime(*job.started_ms);
  if (job.finished_ms) info["finished"] = FormatTime(*job.finished_ms);
  info["updated"] = FormatTime(job.updated_ms);
  if (job.expires_ms) info["expires"] = FormatTime(*job.expires_ms);
  info["priority"] = kPriorityNames.at(static_cast<std::size_t>(job.priority));
  if (job.deadline_ms) info["deadline"] = FormatTime(*job.deadline_ms);
  if (job.timeout_seconds > 0) info["timeout"] = job.timeout_seconds;
  if (job.cost.memory_bytes > 0) {
    info["estimate"] = {{"memoryBytes", job.cost.memory_bytes}, {"seconds", job.cost.seconds}};
  }
  info["filename"] = job.filename;
  info["attempt"] = job.attempt;
  if (!job.timings.empty()) info["timings"] = job.timings;
  info["assumptions"] = ordered_json::array();
  for (const auto& [code, text] : job.assumptions) {
    info["assumptions"].push_back({{"code", code}, {"text", WithParameterNames(text)}});
  }
  if (job.failure) {
    const Problem problem = ProblemOf(*job.failure);
    info["message"] = problem.detail;
    info["exception"] = {{"type", ProblemType(problem.code)},
                         {"title", ReasonPhrase(problem.status)},
                         {"status", problem.status},
                         {"detail", problem.detail},
                         {"code", problem.code.name()}};
  }
  ordered_json links = {Link("self", self), Link("monitor", self), Link("up", base + "/jobs")};
  links.push_back({{"rel", "monitor"}, {"type", "text/event-stream"}, {"href", self + "/events"}});
  if (job.state == JobState::kSuccessful) {
    links.push_back(Link(std::string(kRelations) + "results", self + "/results"));
  } else if (job.state == JobState::kFailed) {
    links.push_back(Link(std::string(kRelations) + "exceptions", self + "/results"));
  }
  info["links"] = links;
  return info;
}

}  // namespace farhorizon
