#pragma once

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// A router over all routes of the service. Requires: context.jobs outlives the router.
Router BuildRouter(const HandlerContext& context);

}  // namespace farhorizon
