#pragma once

#include <optional>

#include "service/handlers/handler_context.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// The answer to a GET of a job whose Prefer asks to wait [RFC 7240, section 4.3]: it comes when
/// the job is another than the one that If-None-Match names, without that field when its status
/// changes, at once where it has ended, and in any case after the wait, 60 seconds at most.
/// nullopt: there is no such wish, or too many wait already.
/// Requires: the request outlives the response.
std::optional<HttpResponse> WaitForJob(const HandlerContext& context, const HttpRequest& request);

}  // namespace farhorizon
