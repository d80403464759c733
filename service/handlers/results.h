#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// GET /jobs/{id}/results: links to the artifacts, with f=zip or f=tar all in one.
/// GET /jobs/{id}/results/{name}: the bytes of one.
std::vector<Route> ResultRoutes(const HandlerContext& context);

/// What is sent, whole or in part.
struct SentSource {
  std::shared_ptr<BodySource> source;
  std::int64_t bytes = 0;
  std::string etag;  ///< strong, with its quotes
  std::string media_type;
  std::string disposition;
};
/// The part of it that the request asks for.
HttpResponse SendSource(const HttpRequest& request, SentSource sent);

/// The bytes of an artifact as it is, for a body. Errors: those of JobService::Open.
Result<std::shared_ptr<BodySource>> OpenSource(JobService& jobs, const std::string& id,
                                               const std::string& name);

/// The bytes of an artifact, or the part of them that the request asks for.
HttpResponse SendArtifact(const HttpRequest& request, OpenArtifact open);
/// The answer to a request for an artifact of `job` that the store did not give.
HttpResponse LostArtifact(const HttpRequest& request, const Job& job, const Error& error);

/// "result-not-available".
Error NoResults();

}  // namespace farhorizon
