#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// What the service says of itself, for clients of OGC API - Processes: GET /conformance, /api,
/// /processes and /processes/{id}.
std::vector<Route> CapabilityRoutes(const HandlerContext& context);

/// The document at "/", for programs.
nlohmann::ordered_json LandingDocument(const std::string& base);

}  // namespace farhorizon
