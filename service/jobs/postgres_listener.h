#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "service/jobs/job_store.h"
#include "service/jobs/postgres.h"

namespace farhorizon {

/// The channel of StoreNews, and its messages.
inline constexpr const char* kNewsChannel = "farhorizon_jobs";
inline constexpr const char* kNewsJobWaits = "job waits";
inline constexpr const char* kNewsRunEnded = "run ended";
/// Before the id of a job that was changed, as the trigger of postgres_schema.cpp tells it.
inline constexpr std::string_view kNewsChanged = "changed ";

/// Tells the news to all who listen, once the transaction is committed.
void Tell(const SqlDatabase& database, const char* news);

/// A thread that hands on what is told over kNewsChannel. A connection that is lost is made anew,
/// later and later, and then everything is told once: it may have been missed.
/// changed: as JobStore::OnChange has it.
class PostgresListener {
 public:
  using Connect = std::function<std::unique_ptr<PostgresDatabase>()>;

  PostgresListener(Connect connect, std::function<void(StoreNews)> handler,
                   std::function<void(const std::string& id)> changed);

 private:
  void Run(const std::stop_token& stop);
  void ListenUntilLost(const std::stop_token& stop);
  void HandOn(const std::string& message);

  Connect connect_;
  std::function<void(StoreNews)> handler_;
  std::function<void(const std::string& id)> changed_;
  int failures_ = 0;
  std::jthread thread_;
};

}  // namespace farhorizon
