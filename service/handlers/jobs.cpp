#include "service/handlers/jobs.h"

#include <optional>
#include <string_view>

#include "core/pipeline/option_numbers.h"
#include "service/handlers/json.h"
#include "service/handlers/problem.h"
#include "service/handlers/status_info.h"

namespace farhorizon {

namespace {

constexpr int kMaxPageSize = 10000;

Error BadQuery(const std::string& what) {
  return {ErrorCode::kInvalidArgument, what, "invalid-query-parameter-value"};
}

Result<int> ReadLimit(const std::string& text) {
  const std::optional<std::int64_t> limit = WholeNumberIn(text);
  if (limit && *limit >= 1 && *limit <= kMaxPageSize) return static_cast<int>(*limit);
  return BadQuery("limit must be a whole number from 1 to 10000");
}

Result<std::vector<JobState>> ReadStates(std::string_view text) {
  std::vector<JobState> states;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::optional<JobState> state = JobStateOf(text.substr(0, comma));
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
    if (!state) {
      return BadQuery("status must be a list of accepted, running, successful, failed, dismissed");
    }
    states.push_back(*state);
  }
  return states;
}

Result<JobQuery> ReadQuery(const Parameters& parameters) {
  JobQuery query;
  for (const auto& [name, value] : parameters) {
    if (name == "limit") {
      Result<int> limit = ReadLimit(value);
      if (!limit) return std::move(limit.error());
      query.limit = *limit;
    } else if (name == "status") {
      Result<std::vector<JobState>> states = ReadStates(value);
      if (!states) return std::move(states.error());
      query.states = *std::move(states);
    } else if (name == "cursor") {
      if (!IsJobId(value)) return BadQuery("cursor must come from a next link");
      query.before = value;
    } else {
      return BadQuery("there is no parameter '" + name + "'; known are limit, status and cursor");
    }
  }
  return query;
}

HttpResponse ListJobs(const HandlerContext& context, const HttpRequest& request) {
  const std::optional<Parameters> parameters = DecodeQuery(request.query, {"status"});
  Result<JobQuery> query =
      parameters ? ReadQuery(*parameters) : Result<JobQuery>(BadQuery("the query cannot be read"));
  if (!query) return ProblemResponse(request, ProblemOf(query.error()));
  if (!request.caller.SeesAll()) query->owner = request.caller.owner;
  Result<JobPage> page = context.jobs.List(*query);
  if (!page) return ProblemResponse(request, ProblemOf(page.error()));
  nlohmann::ordered_json document = {{"jobs", nlohmann::ordered_json::array()},
                                     {"links", nlohmann::ordered_json::array()}};
  for (const Job& job : page->jobs) document["jobs"].push_back(StatusInfo(job, context.base));
  const auto link = [&](const char* relation, const Parameters& with) {
    const std::string text = EncodeQuery(with);
    document["links"].push_back(
        {{"rel", relation},
         {"type", "application/json"},
         {"href", context.base + "/jobs" + (text.empty() ? "" : "?") + text}});
  };
  link("self", *parameters);
  if (page->next) {
    Parameters next = *parameters;
    next["cursor"] = *page->next;
    link("next", next);
  }
  return TaggedJsonResponse(request, document);
}

HttpResponse ShowJob(const HandlerContext& context, const HttpRequest& request) {
  const Result<Job> job = FindJob(context, request);
  if (!job) return ProblemResponse(request, ProblemOf(job.error()));
  HttpResponse response = TaggedJsonResponse(request, StatusInfo(*job, context.base));
  response.job_id = job->id;
  if (!IsTerminal(job->state)) response.Set("Retry-After", "1");
  return response;
}

HttpResponse DismissJob(const HandlerContext& context, const HttpRequest& request) {
  Result<Job> job = FindJob(context, request);
  if (job) job = context.jobs.Dismiss(job->id);
  if (!job) return ProblemResponse(request, ProblemOf(job.error()));
  HttpResponse response = JsonResponse(StatusInfo(*job, context.base));
  response.job_id = job->id;
  return response;
}

}  // namespace

Result<Job> FindJob(const HandlerContext& context, const HttpRequest& request) {
  const std::string& id = request.parameters.at(0);
  if (!IsJobId(id)) return NoSuchJob();
  Result<Job> job = context.jobs.Find(id);
  if (job && !request.caller.Sees(job->owner)) return NoSuchJob();
  return job;
}

std::vector<Route> JobRoutes(const HandlerContext& context) {
  return {
      BodylessRoute("GET", "/jobs",
                    [context](const HttpRequest& request) { return ListJobs(context, request); }),
      BodylessRoute("GET", "/jobs/{id}",
                    [context](const HttpRequest& request) { return ShowJob(context, request); }),
      BodylessRoute("DELETE", "/jobs/{id}", [context](const HttpRequest& request) {
        return DismissJob(context, request);
      })};
}

}  // namespace farhorizon
