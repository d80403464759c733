#pragma once

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// GET /jobs/{id}/events: Server-Sent Events [HTML, section 9.2]. An event is the job's whole
/// status; its id is the status's entity tag, so that any service on the store can go on from it.
/// Whoever is slow misses statuses that others have followed, never the last one.
Route EventsRoute(const HandlerContext& context);

}  // namespace farhorizon
