#include "service/handlers/routes.h"

#include <utility>
#include <vector>

#include "service/handlers/capabilities.h"
#include "service/handlers/events.h"
#include "service/handlers/execute.h"
#include "service/handlers/health.h"
#include "service/handlers/jobs.h"
#include "service/handlers/pages.h"
#include "service/handlers/results.h"
#include "service/handlers/submit.h"
#include "service/handlers/tickets.h"
#include "service/handlers/uploads.h"

namespace farhorizon {

Router BuildRouter(const HandlerContext& context) {
  std::vector<Route> routes = {SubmitRoute(context), ExecutionRoute(context), TicketRoute(context),
                               EventsRoute(context)};
  for (const std::vector<Route>& group :
       {JobRoutes(context), ResultRoutes(context), HealthRoutes(context), PageRoutes(context),
        CapabilityRoutes(context), UploadRoutes(context)}) {
    routes.insert(routes.end(), group.begin(), group.end());
  }
  return Router(std::move(routes));
}

Router BuildHealthRouter(const HandlerContext& context) { return Router(HealthRoutes(context)); }

}  // namespace farhorizon
