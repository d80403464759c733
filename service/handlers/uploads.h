#pragma once

#include <string>
#include <vector>

#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"
#include "service/jobs/upload.h"

namespace farhorizon {

/// Resumable uploads [Tus]: /uploads and /uploads/{id}.
std::vector<Route> UploadRoutes(const HandlerContext& context);

/// The caller's upload. Errors: kNotFound "no-such-upload", also for one of another's.
Result<Upload> FindUpload(const HandlerContext& context, const HttpRequest& request,
                          const std::string& id);

}  // namespace farhorizon
