#pragma once

#include <vector>

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// GET /jobs/{id}/results: links to the artifacts. GET /jobs/{id}/results/{name}: the bytes of one.
std::vector<Route> ResultRoutes(const HandlerContext& context);

}  // namespace farhorizon
