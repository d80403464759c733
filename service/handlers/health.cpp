#include "service/handlers/health.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/pipeline/version.h"
#include "service/handlers/json.h"
#include "service/handlers/problem.h"
#include "service/log.h"
#include "service/metrics.h"

namespace farhorizon {

namespace {

bool AllSucceed(const std::vector<ReadinessCheck>& checks) {
  return std::all_of(checks.begin(), checks.end(),
                     [](const ReadinessCheck& check) { return static_cast<bool>(check.status); });
}

nlohmann::ordered_json Listed(const std::vector<ReadinessCheck>& checks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ReadinessCheck& check : checks) {
    nlohmann::ordered_json entry = {{"name", check.name}, {"ok", static_cast<bool>(check.status)}};
    if (!check.status) {
      const Problem problem = ProblemOf(check.status.error());
      entry["code"] = problem.code.name();
      entry["detail"] = problem.detail;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

HttpResponse Ready(const HandlerContext& context, const HttpRequest& request) {
  const std::vector<ReadinessCheck> checks = context.jobs.CheckReady();
  const std::vector<std::string> sandbox = NamesOf(context.jobs.ActiveSandbox());
  if (AllSucceed(checks)) {
    return JsonResponse({{"status", "ready"}, {"checks", Listed(checks)}, {"sandbox", sandbox}});
  }
  const auto failed = std::find_if(checks.begin(), checks.end(),
                                   [](const ReadinessCheck& check) { return !check.status; });
  Problem problem = ProblemOf(failed->status.error());
  problem.status = 503;
  for (const ReadinessCheck& check : checks) {
    if (check.status) continue;
    Log(LogLevel::kWarning, "not ready",
        {{"check", std::string(check.name)}, {"error", check.status.error().message}});
  }
  HttpResponse response = ProblemResponse(request, problem);
  auto document = nlohmann::ordered_json::parse(response.body);
  document["checks"] = Listed(checks);
  document["sandbox"] = sandbox;
  response.body = DumpJson(document);
  return response;
}

HttpResponse Metrics(const HandlerContext& context) {
  const Result<UnfinishedJobs> jobs = context.jobs.CountUnfinished();
  const UnfinishedJobs counts = jobs ? *jobs : UnfinishedJobs{};
  const Result<std::int64_t> room = context.jobs.FreeBytes();
  const Result<UploadCounts> counted = context.jobs.Uploads().Count();
  const UploadCounts uploads = counted ? *counted : UploadCounts{};
  HttpResponse response;
  response.Set("Content-Type", "text/plain; version=0.0.4; charset=utf-8");
  response.Set("Cache-Control", "no-store");
  response.body = MetricsText({counts.accepted, counts.running, room ? *room : 0, LogLinesDropped(),
                               AllSucceed(context.jobs.CheckReady()), Version(),
                               context.jobs.CountWatches(), uploads.uploads, uploads.bytes});
  return response;
}

}  // namespace

std::vector<Route> HealthRoutes(const HandlerContext& context) {
  return {
      BodylessRoute(
          "GET", "/healthz",
          [](const HttpRequest&) {
            return JsonResponse({{"status", "ok"}});
          },
          WaitsFor::kNothing),
      BodylessRoute("GET", "/readyz",
                    [context](const HttpRequest& request) { return Ready(context, request); }),
      BodylessRoute("GET", "/metrics", [context](const HttpRequest&) { return Metrics(context); })};
}

}  // namespace farhorizon
