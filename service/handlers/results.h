#pragma once

#include <vector>

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// GET /jobs/{id}/results: links to the artifacts. GET /jobs/{id}/results/{name}: the bytes of one.
std::vector<Route> ResultRoutes(const HandlerContext& context);

/// The bytes of an artifact, or the part of them that the request asks for.
HttpResponse SendArtifact(const HttpRequest& request, OpenArtifact open);
/// The answer to a request for an artifact of `job` that the store did not give.
HttpResponse LostArtifact(const HttpRequest& request, const Job& job, const Error& error);

/// "result-not-available".
Error NoResults();

}  // namespace farhorizon
