#include "service/handlers/jobs.h"

#include <optional>

#include "service/clock.h"
#include "service/handlers/job_query.h"
#include "service/handlers/job_wait.h"
#include "service/handlers/json.h"
#include "service/handlers/problem.h"
#include "service/handlers/status_info.h"

namespace farhorizon {

namespace {

HttpResponse ListJobs(const HandlerContext& context, const HttpRequest& request) {
  const std::optional<Parameters> parameters =
      DecodeQuery(request.query, {"processID", "status", "type"});
  if (!parameters) {
    return ProblemResponse(request, {"invalid-query-parameter-value", "the query cannot be read"});
  }
  Result<JobListRequest> asked = ReadJobQuery(*parameters, NowMs());
  if (!asked) return ProblemResponse(request, ProblemOf(asked.error()));
  if (!request.caller.SeesAll()) asked->query.owner = request.caller.owner;
  Result<JobPage> page = asked->none ? JobPage() : context.jobs.List(asked->query);
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

HttpResponse ShowJob(const HandlerContext& context, const HttpRequest& request) {
  const Result<Job> job = FindJob(context, request);
  if (!job) return ProblemResponse(request, ProblemOf(job.error()));
  HttpResponse response = TaggedJsonResponse(request, StatusInfo(*job, context.base));
  response.job_id = job->id;
  if (!IsTerminal(job->state)) response.Set("Retry-After", "1");
  return response;
}

std::vector<Route> JobRoutes(const HandlerContext& context) {
  return {
      BodylessRoute("GET", "/jobs",
                    [context](const HttpRequest& request) { return ListJobs(context, request); }),
      BodylessRoute("GET", "/jobs/{id}",
                    [context](const HttpRequest& request) {
                      std::optional<HttpResponse> late = WaitForJob(context, request);
                      return late ? *std::move(late) : ShowJob(context, request);
                    }),
      BodylessRoute("DELETE", "/jobs/{id}", [context](const HttpRequest& request) {
        return DismissJob(context, request);
      })};
}

}  // namespace farhorizon
