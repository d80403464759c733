#pragma once

#include <vector>

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// GET /: a page of all jobs for browsers, links for programs. GET /viewer/{id}: a job's levels, in
/// CesiumJS. GET /assets/{fingerprint}/{path*}: what these pages consist of.
std::vector<Route> PageRoutes(const HandlerContext& context);

/// Whether the request would rather have HTML than JSON: its Accept names text/html with a weight
/// that is not 0 and not below that of application/json [RFC 9110, section 12.5.1]. A request that
/// takes anything has JSON, as programs do.
bool WantsHtml(const HttpRequest& request);

}  // namespace farhorizon
