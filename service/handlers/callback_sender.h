#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "service/handlers/handler_context.h"
#include "service/jobs/callback.h"
#include "service/outgoing/callback_rules.h"

namespace farhorizon {

/// Threads that call subscribers: claim a call that is due, make it, and note how it went. Of
/// services that share a store each does it, and a claim is one service's.
///
/// Each event is told of at least once: a service that ends between a call and its note is followed
/// by a second call with the same webhook-id. What is not taken, by an answer of 2xx within five
/// seconds, is tried again after random times that grow to ten minutes, until `retry_time` is over;
/// 410 ends it at once.
class CallbackSender {
 public:
  /// Requires: context.callbacks; context.jobs outlives this object.
  CallbackSender(HandlerContext context, const CallbackOptions& options);
  ~CallbackSender() { Stop(); }
  CallbackSender(const CallbackSender&) = delete;
  CallbackSender& operator=(const CallbackSender&) = delete;

  /// Ends the threads; what they were about to say is said by the next service. The last call.
  void Stop();

 private:
  void Run();
  /// Claims the next call; nullopt where none is due, or a stop was requested meanwhile.
  std::optional<DueCallback> Next();
  void Send(const DueCallback& callback);
  void PutOff(const DueCallback& callback, const std::string& why, bool for_good);
  /// The document for the subscriber. Errors: those of JobService.
  Result<std::string> BodyOf(const DueCallback& callback);
  void Warn(const Error& error);

  const HandlerContext context_;
  const CallbackOptions options_;
  std::mutex mutex_;  // of one claim after the other
  std::chrono::steady_clock::time_point next_look_;
  std::stop_source stop_;
  std::vector<std::thread> threads_;
};

}  // namespace farhorizon
