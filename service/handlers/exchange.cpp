#include "service/handlers/exchange.h"

#include <exception>

#include "service/handlers/problem.h"
#include "service/log.h"

namespace farhorizon {

HttpResponse FinishExchange(Exchange& exchange, const HttpRequest& request) {
  try {
    return exchange.Finish();
  } catch (const std::exception& bug) {
    Log(LogLevel::kError, "internal error", {{"path", request.path}, {"error", bug.what()}});
    return ProblemResponse(request,
                           {"internal-error", "the service failed inside; its log says why"});
  }
}

void AbandonExchange(Exchange& exchange, const HttpRequest& request) {
  try {
    exchange.Abandon();
  } catch (const std::exception& bug) {
    Log(LogLevel::kError, "internal error", {{"path", request.path}, {"error", bug.what()}});
  }
}

}  // namespace farhorizon
