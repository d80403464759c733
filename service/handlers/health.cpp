#include "service/handlers/health.h"

#include "service/handlers/json.h"
#include "service/handlers/problem.h"

namespace farhorizon {

std::vector<Route> HealthRoutes(const HandlerContext& context) {
  return {BodylessRoute(
              "GET", "/healthz",
              [](const HttpRequest&) {
                return JsonResponse({{"status", "ok"}});
              },
              WaitsFor::kNothing),
          BodylessRoute("GET", "/readyz", [context](const HttpRequest& request) {
            const Status ready = context.jobs.CheckReady();
            if (ready) return JsonResponse({{"status", "ready"}});
            Problem problem = ProblemOf(ready.error());
            problem.status = 503;
            return ProblemResponse(request, problem);
          })};
}

}  // namespace farhorizon
