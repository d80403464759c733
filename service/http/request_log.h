#pragma once

#include <chrono>

#include "service/handlers/http_message.h"

namespace farhorizon {

/// One line of the log about an answered request: who asked for what, what the answer was, and the
/// ids by which it is found again (request, key, trace, job). Requests for the service's health are
/// at the level of debugging.
void LogRequest(const HttpRequest& request, const HttpResponse& response,
                std::chrono::nanoseconds took);

}  // namespace farhorizon
