#pragma once

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// POST /jobs. The body is a DEM, with its parameters in the query, or a multipart form with the
/// parts `dem` and `params`.
Route SubmitRoute(const HandlerContext& context);

}  // namespace farhorizon
