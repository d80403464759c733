#include "service/handlers/events.h"

#include <memory>
#include <string>
#include <utility>

#include "service/handlers/jobs.h"
#include "service/handlers/json.h"
#include "service/handlers/key_gate.h"
#include "service/handlers/problem.h"
#include "service/handlers/status_info.h"
#include "service/handlers/submit.h"

namespace farhorizon {

namespace {

// How long a client waits before it connects again.
constexpr const char* kRetry = "retry: 2000\n\n";

// An event's id: the entity tag of GET /jobs/{id}, without its quotes.
std::string IdOf(const std::string& document) {
  const std::string tag = TagOf(document);
  return tag.substr(1, tag.size() - 2);
}

class JobEvents : public EventSource {
 public:
  JobEvents(const HandlerContext& context, const HttpRequest& request, std::string last_id,
            std::unique_ptr<JobChanges::Watch> watch)
      : context_(context),
        caller_(request.caller),
        job_(request.parameters.at(0)),
        last_id_(std::move(last_id)),
        watch_(std::move(watch)) {}

  void Listen(std::function<void()> wake) override { watch_->Listen(std::move(wake)); }
  Piece Next() override {
    const bool admitted = context_.gate == nullptr || context_.gate->StillGood(caller_);
    const Result<Job> job = context_.jobs.Find(job_);
    // A store that does not answer now may soon: a client that is sent away then does not come
    // back.
    if (admitted && !job && job.error().code != ErrorCode::kNotFound) return {"", false};
    if (!admitted || !job || !caller_.Sees(job->owner)) return {"", true};
    Piece piece{std::exchange(begun_, true) ? "" : kRetry, IsTerminal(job->state)};
    const std::string document = DumpJson(StatusInfo(*job, context_.base));
    std::string id = IdOf(document);
    if (id == last_id_) return piece;
    // The document ends in the newline that ends its field.
    piece.text += "id: " + id + "\nevent: status\ndata: " + document + "\n";
    last_id_ = std::move(id);
    return piece;
  }

 private:
  const HandlerContext context_;
  const Caller caller_;
  const std::string job_;
  std::string last_id_;
  std::unique_ptr<JobChanges::Watch> watch_;
  bool begun_ = false;
};

HttpResponse SendEvents(const HandlerContext& context, const HttpRequest& request) {
  const Result<Job> job = FindJob(context, request);
  if (!job) return ProblemResponse(request, ProblemOf(job.error()));
  const std::string* field = request.Header("last-event-id");
  std::string last_id = field == nullptr ? "" : *field;
  HttpResponse response;
  response.job_id = job->id;
  response.Set("Cache-Control", "no-store");
  // A browser connects again after every end but this one.
  if (IsTerminal(job->state) && last_id == IdOf(DumpJson(StatusInfo(*job, context.base)))) {
    response.status = 204;
    return response;
  }
  auto watch = context.jobs.Watch(job->id, ClientOf(request));
  if (!watch) {
    return ProblemResponse(request, {"too-many-connections",
                                     "too many requests wait for changes of jobs; try again soon, "
                                     "or ask for /jobs/" +
                                         job->id + " itself"});
  }
  response.Set("Content-Type", "text/event-stream");
  response.events =
      std::make_shared<JobEvents>(context, request, std::move(last_id), std::move(watch));
  return response;
}

}  // namespace

Route EventsRoute(const HandlerContext& context) {
  return BodylessRoute("GET", "/jobs/{id}/events", [context](const HttpRequest& request) {
    return SendEvents(context, request);
  });
}

}  // namespace farhorizon
