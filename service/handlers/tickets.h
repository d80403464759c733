#pragma once

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// POST /jobs/{id}/ticket: what a page puts at the end of a link to a result, as `?ticket=`, so
/// that the browser opens or downloads it by itself, without the field that has the key.
Route TicketRoute(const HandlerContext& context);

}  // namespace farhorizon
