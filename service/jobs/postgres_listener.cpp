#include "service/jobs/postgres_listener.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "service/clock.h"

namespace farhorizon {

namespace {

// Whoever stops the thread waits for so long.
constexpr std::chrono::milliseconds kWait{200};
constexpr std::chrono::milliseconds kFirstPause{100};
constexpr std::chrono::milliseconds kLongestPause{5000};

}  // namespace

void Tell(const SqlDatabase& database, const char* news) {
  Statement(database, std::string("SELECT pg_notify('") + kNewsChannel + "', '" + news + "')")
      .Run();
}

PostgresListener::PostgresListener(Connect connect, std::function<void(StoreNews)> handler,
                                   std::function<void(const std::string& id)> changed)
    : connect_(std::move(connect)),
      handler_(std::move(handler)),
      changed_(std::move(changed)),
      thread_([this](const std::stop_token& stop) { Run(stop); }) {}

void PostgresListener::Run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      ListenUntilLost(stop);
    } catch (const SqlFailure&) {
      Pause(std::min(kLongestPause, kFirstPause * (1 << std::min(failures_++, 10))), stop);
    }
  }
}

void PostgresListener::ListenUntilLost(const std::stop_token& stop) {
  const std::unique_ptr<PostgresDatabase> database = connect_();
  database->Listen(kNewsChannel);
  failures_ = 0;
  handler_(StoreNews::kJobWaits);
  handler_(StoreNews::kRunEnded);
  changed_("");
  while (!stop.stop_requested()) {
    for (const std::string& message : database->Wait(kWait)) HandOn(message);
  }
}

void PostgresListener::HandOn(const std::string& message) {
  if (message == kNewsJobWaits) return handler_(StoreNews::kJobWaits);
  if (message == kNewsRunEnded) return handler_(StoreNews::kRunEnded);
  if (message.starts_with(kNewsChanged)) changed_(message.substr(kNewsChanged.size()));
}

}  // namespace farhorizon
