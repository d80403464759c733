#pragma once

#include <string>
#include <vector>

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// GET /jobs, GET and DELETE /jobs/{id}. With Prefer: wait the second waits for a change.
std::vector<Route> JobRoutes(const HandlerContext& context);

/// The job that the path of the request names, if its caller may see it. Text that is not of the
/// form of an id does not reach the store.
/// Errors: kNotFound "no-such-job", for another's job likewise; those of the store.
Result<Job> FindJob(const HandlerContext& context, const HttpRequest& request);

/// GET /jobs/{id}, answered at once.
HttpResponse ShowJob(const HandlerContext& context, const HttpRequest& request);

}  // namespace farhorizon
