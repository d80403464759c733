#pragma once

#include <string>

#include "service/handlers/http_message.h"

namespace farhorizon {

/// What the lines of the log about a request have in common with those of other programs.
/// The client's X-Request-Id, if it has 1 to 200 bytes; else 16 random bytes as hexadecimal.
std::string RequestIdOf(const HttpRequest& request);

/// The 32 hexadecimal digits of the trace in traceparent [W3C Trace Context]; empty where there is
/// no such field, or it is invalid.
std::string TraceIdOf(const HttpRequest& request);

}  // namespace farhorizon
