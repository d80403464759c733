#pragma once

#include <nlohmann/json.hpp>

#include "service/handlers/router.h"
#include "service/handlers/submit.h"

namespace farhorizon {

/// GET /jobs, GET and DELETE /jobs/{id}.
std::vector<Route> JobRoutes(const HandlerContext& context);
/// GET /jobs/{id}/results, GET /jobs/{id}/results/{name}.
std::vector<Route> ResultRoutes(const HandlerContext& context);
/// GET /healthz, GET /readyz.
std::vector<Route> HealthRoutes(const HandlerContext& context);

/// All of the service. Requires: context.jobs outlives the router.
Router BuildRouter(const HandlerContext& context);

/// 200 with this document.
HttpResponse JsonResponse(const nlohmann::ordered_json& document);

}  // namespace farhorizon
