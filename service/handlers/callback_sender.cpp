#include "service/handlers/callback_sender.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "service/clock.h"
#include "service/handlers/json.h"
#include "service/handlers/result_answer.h"
#include "service/handlers/status_info.h"
#include "service/log.h"
#include "service/metrics.h"
#include "service/outgoing/outgoing_client.h"
#include "service/random.h"

namespace farhorizon {

namespace {

using std::chrono::duration_cast;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr milliseconds kCallTime{5000};
// Longer than a call and its note take; so long a frozen service holds up a call.
constexpr milliseconds kLease{20'000};
// How soon an event is seen to be due.
constexpr milliseconds kLookInterval{500};
constexpr milliseconds kFirstDelay{1000};
constexpr milliseconds kLongestDelay{600'000};

}  // namespace

CallbackSender::CallbackSender(HandlerContext context, const CallbackOptions& options)
    : context_(std::move(context)), options_(options) {
  for (int i = 0; i < options_.at_once; ++i) threads_.emplace_back([this] { Run(); });
}

void CallbackSender::Stop() {
  stop_.request_stop();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void CallbackSender::Run() {
  while (!stop_.stop_requested()) {
    if (const std::optional<DueCallback> callback = Next()) Send(*callback);
  }
}

// The threads wait for the mutex while one of them waits for the time: of many that have nothing to
// do one alone asks the store.
std::optional<DueCallback> CallbackSender::Next() {
  const std::lock_guard lock(mutex_);
  const auto now = steady_clock::now();
  if (now < next_look_) Pause(duration_cast<milliseconds>(next_look_ - now), stop_.get_token());
  if (stop_.stop_requested()) return std::nullopt;
  Result<std::optional<DueCallback>> callback = context_.jobs.ClaimCallback(kLease);
  if (!callback) Warn(callback.error());
  if (!callback || !*callback) next_look_ = steady_clock::now() + kLookInterval;
  return callback ? *callback : std::nullopt;
}

Result<std::string> CallbackSender::BodyOf(const DueCallback& callback) {
  const Result<Job> job = context_.jobs.Find(callback.job_id);
  if (!job) return job.error();
  if (callback.event != CallbackEvent::kSuccess) return DumpJson(StatusInfo(*job, context_.base));
  const Result<nlohmann::ordered_json> links = ResultLinks(context_, *job);
  if (!links) return links.error();
  return DumpJson(*links);
}

void CallbackSender::Send(const DueCallback& callback) {
  const Result<OutgoingUrl> url = context_.callbacks->Check(callback.url);
  if (!url) return PutOff(callback, url.error().message, true);
  Result<std::string> body = BodyOf(callback);
  if (!body) {
    if (body.error().code == ErrorCode::kNotFound) return;  // removed, and its rows with it
    return PutOff(callback, body.error().message, false);
  }
  // Without a dot, which parts what is signed.
  const std::string id = callback.job_id + "-" + NameOf(callback.event);
  const std::int64_t now = NowMs() / 1000;
  OutgoingRequest request{*url};
  request.is_post = true;
  request.time = kCallTime;
  request.headers = {"Content-Type: application/json", "webhook-id: " + id,
                     "webhook-timestamp: " + std::to_string(now),
                     "webhook-signature: " + context_.callbacks->secrets().Sign(id, now, *body)};
  request.body = *std::move(body);
  const Result<OutgoingResponse> response =
      SendOutgoing(request, context_.callbacks->addresses(), stop_.get_token());
  if (!response) {
    if (response.error().code == ErrorCode::kCancelled) {
      static_cast<void>(context_.jobs.RetryCallback(callback, milliseconds(0)));
      return;
    }
    return PutOff(callback, response.error().message, false);
  }
  if (response->status < 200 || response->status > 299) {
    return PutOff(callback, url->host + " answered " + std::to_string(response->status),
                  response->status == 410);
  }
  const Result<bool> noted = context_.jobs.EndCallback(callback, CallbackEnd::kDelivered);
  if (!noted) Warn(noted.error());
  CountCallback(NameOf(callback.event), "delivered");
  Log(LogLevel::kInfo, "subscriber called",
      {{"job_id", callback.job_id},
       {"event", NameOf(callback.event)},
       {"host", url->host},
       {"address", response->address},
       {"status", std::int64_t{response->status}},
       {"attempt", callback.attempt}});
}

void CallbackSender::PutOff(const DueCallback& callback, const std::string& why, bool for_good) {
  const bool over = for_good || callback.age >= options_.retry_time;
  const milliseconds left = duration_cast<milliseconds>(options_.retry_time) - callback.age;
  const milliseconds delay =
      over ? milliseconds(0)
           : std::min(RandomDelay(kFirstDelay, kLongestDelay, callback.attempt - 1), left);
  const Result<bool> noted = over ? context_.jobs.EndCallback(callback, CallbackEnd::kGivenUp)
                                  : context_.jobs.RetryCallback(callback, delay);
  if (!noted) Warn(noted.error());
  CountCallback(NameOf(callback.event), over ? "given-up" : "failed");
  Log(over ? LogLevel::kError : LogLevel::kWarning,
      over ? "a subscriber is given up" : "a subscriber was not reached",
      {{"job_id", callback.job_id},
       {"event", NameOf(callback.event)},
       {"error", why},
       {"attempt", callback.attempt},
       {"again_ms", std::int64_t{delay.count()}}});
}

void CallbackSender::Warn(const Error& error) {
  Log(LogLevel::kWarning, "calls to subscribers are left", {{"error", error.message}});
}

}  // namespace farhorizon
