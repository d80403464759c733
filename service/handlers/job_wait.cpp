#include "service/handlers/job_wait.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "service/handlers/jobs.h"
#include "service/handlers/preferences.h"
#include "service/handlers/submit.h"

namespace farhorizon {

namespace {

class JobWait : public LateResponse {
 public:
  JobWait(const HandlerContext& context, const HttpRequest& request, std::int64_t seconds,
          std::unique_ptr<JobChanges::Watch> watch)
      : context_(context), request_(request), seconds_(seconds), watch_(std::move(watch)) {}

  void Listen(std::function<void()> wake) override { watch_->Listen(std::move(wake)); }
  [[nodiscard]] std::chrono::seconds Most() const override {
    return std::chrono::seconds(seconds_);
  }
  std::unique_ptr<HttpResponse> Try(bool last) override {
    const Result<Job> job = FindJob(context_, request_);
    if (job && !seen_) seen_ = job->state;
    HttpResponse response = ShowJob(context_, request_);
    const bool has_tag = request_.Header("if-none-match") != nullptr;
    const bool news =
        !job || IsTerminal(job->state) || (has_tag ? response.status != 304 : job->state != *seen_);
    if (!news && !last) return nullptr;
    response.Set("Preference-Applied", "wait=" + std::to_string(seconds_));
    return std::make_unique<HttpResponse>(std::move(response));
  }

 private:
  const HandlerContext context_;
  const HttpRequest& request_;
  const std::int64_t seconds_;
  std::unique_ptr<JobChanges::Watch> watch_;
  std::optional<JobState> seen_;
};

}  // namespace

std::optional<HttpResponse> WaitForJob(const HandlerContext& context, const HttpRequest& request) {
  const std::int64_t seconds =
      std::min(PreferencesOf(request).wait_seconds.value_or(0), kMostWaitSeconds);
  if (seconds == 0 || request.method != "GET" || !IsJobId(request.parameters.at(0))) {
    return std::nullopt;
  }
  auto watch = context.jobs.Watch(request.parameters.at(0), ClientOf(request));
  if (!watch) return std::nullopt;
  HttpResponse response;
  response.late = std::make_shared<JobWait>(context, request, seconds, std::move(watch));
  return response;
}

}  // namespace farhorizon
