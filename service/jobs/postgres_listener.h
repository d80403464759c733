#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>

#include "service/jobs/job_store.h"
#include "service/jobs/postgres.h"

namespace farhorizon {

/// The channel of StoreNews, and its messages.
inline constexpr const char* kNewsChannel = "farhorizon_jobs";
inline constexpr const char* kNewsJobWaits = "job waits";
inline constexpr const char* kNewsRunEnded = "run ended";

/// A thread that hands on what is told over kNewsChannel. A connection that is lost is made anew,
/// later and later, and then everything is told once: it may have been missed.
class PostgresListener {
 public:
  using Connect = std::function<std::unique_ptr<PostgresDatabase>()>;

  PostgresListener(Connect connect, std::function<void(StoreNews)> handler);

 private:
  void Run(const std::stop_token& stop);
  void ListenUntilLost(const std::stop_token& stop);

  Connect connect_;
  std::function<void(StoreNews)> handler_;
  int failures_ = 0;
  std::jthread thread_;
};

}  // namespace farhorizon
