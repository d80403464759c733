#pragma once

#include <vector>

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// GET /healthz: the process answers. GET /readyz: it would take a job now, else 503.
std::vector<Route> HealthRoutes(const HandlerContext& context);

}  // namespace farhorizon
