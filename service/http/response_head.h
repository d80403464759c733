#pragma once

#include <string>

#include "service/handlers/http_message.h"
#include "service/http/access_rules.h"

namespace farhorizon {

/// The status line and all fields of a response, with the empty line that closes them.
///
/// request: its id is said. A response without a Content-Security-Policy gets the one that allows
/// nothing.
std::string ResponseHead(const HttpRequest& request, const HttpResponse& response, bool keep_alive,
                         const Cors& cors);

}  // namespace farhorizon
