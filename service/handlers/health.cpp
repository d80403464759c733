#include "service/handlers/json.h"
#include "service/handlers/problem.h"
#include "service/handlers/routes.h"

namespace farhorizon {

HttpResponse JsonResponse(const nlohmann::ordered_json& document) {
  HttpResponse response;
  response.Set("Content-Type", "application/json");
  response.Set("Cache-Control", "no-store");
  response.body = DumpJson(document);
  return response;
}

std::vector<Route> HealthRoutes(const HandlerContext& context) {
  return {{"GET", "/healthz",
           [](const HttpRequest&, BodySink*) {
             return JsonResponse({{"status", "ok"}});
           }},
          {"GET", "/readyz", [context](const HttpRequest& request, BodySink*) {
             Status ready = context.jobs.CheckReady();
             if (ready) return JsonResponse({{"status", "ready"}});
             Problem problem = ProblemOf(ready.error());
             problem.status = 503;
             return ProblemResponse(request, problem);
           }}};
}

Router BuildRouter(const HandlerContext& context) {
  std::vector<Route> routes = {SubmitRoute(context)};
  for (std::vector<Route> group :
       {JobRoutes(context), ResultRoutes(context), HealthRoutes(context)}) {
    for (Route& route : group) routes.push_back(std::move(route));
  }
  return Router(std::move(routes));
}

}  // namespace farhorizon
