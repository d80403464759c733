#pragma once

#include <string>

#include "service/handlers/http_message.h"

namespace farhorizon {

/// The status line and all fields of a response, with the empty line that closes them.
///
/// request: echoed are its X-Request-Id of up to 200 bytes. cors_origin: what
/// Access-Control-Allow-Origin says; empty: no such field. A response without a
/// Content-Security-Policy gets the one that allows nothing.
std::string ResponseHead(const HttpRequest& request, const HttpResponse& response, bool keep_alive,
                         const std::string& cors_origin);

}  // namespace farhorizon
