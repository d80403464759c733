#pragma once

#include <string>

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// POST /processes/{id}/execution.
Route ExecutionRoute(const HandlerContext& context);

/// Begins an execution by a request whose body is JSON. process: as ReadExecuteRequest has it, one
/// that is offered.
Admission BeginExecution(const HandlerContext& context, const HttpRequest& request,
                         const std::string& process);

}  // namespace farhorizon
