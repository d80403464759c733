#pragma once

#include <string>
#include <vector>

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// GET /jobs, GET and DELETE /jobs/{id}.
std::vector<Route> JobRoutes(const HandlerContext& context);

/// The job with the id that a client sent. Text that is not of the form of an id does not reach the
/// store. Errors: kNotFound "no-such-job", and those of the store.
Result<Job> FindJob(const HandlerContext& context, const std::string& id);

}  // namespace farhorizon
