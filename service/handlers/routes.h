#pragma once

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// A router over all routes of the service. Requires: context.jobs outlives the router.
Router BuildRouter(const HandlerContext& context);

/// Those of its routes that tell how it is: for a process that works and answers no client.
Router BuildHealthRouter(const HandlerContext& context);

}  // namespace farhorizon
