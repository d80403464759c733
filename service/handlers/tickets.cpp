#include "service/handlers/tickets.h"

#include <string>

#include "service/clock.h"
#include "service/handlers/jobs.h"
#include "service/handlers/json.h"
#include "service/handlers/key_gate.h"
#include "service/handlers/problem.h"

namespace farhorizon {

namespace {

HttpResponse MakeTicket(const HandlerContext& context, const HttpRequest& request) {
  const Result<Job> job = FindJob(context, request);
  if (!job) return ProblemResponse(request, ProblemOf(job.error()));
  const std::int64_t expires_ms = NowMs() + LinkTickets::kLifetimeMs;
  // Without keys a link needs none: any text does.
  const std::string ticket =
      context.gate == nullptr ? "" : context.gate->MakeTicket(request.caller, job->id, expires_ms);
  HttpResponse response = JsonResponse({{"ticket", ticket}, {"expires", FormatTime(expires_ms)}});
  response.Set("Cache-Control", "no-store");
  response.job_id = job->id;
  return response;
}

}  // namespace

Route TicketRoute(const HandlerContext& context) {
  return BodylessRoute("POST", "/jobs/{id}/ticket", [context](const HttpRequest& request) {
    return MakeTicket(context, request);
  });
}

}  // namespace farhorizon
