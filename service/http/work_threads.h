#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

#include "service/asio.h"
#include "service/handlers/router.h"
#include "service/http/server.h"

namespace farhorizon {

/// The threads of a server that do what may wait, so that those that move bytes never do.
struct WorkThreads {
  explicit WorkThreads(const ServerOptions& options)
      : store(static_cast<std::size_t>(options.handler_threads)),
        uploads(static_cast<std::size_t>(options.upload_threads)) {}

  asio::thread_pool store;    ///< for what waits for disk and database
  asio::thread_pool uploads;  ///< for what waits for a process
};

/// Runs `work` on the threads for what `waits_for` says, and waits for it without a thread.
template <typename Work>
asio::awaitable<std::invoke_result_t<Work>> RunOn(WorkThreads& threads, WaitsFor waits_for,
                                                  Work work) {
  if (waits_for == WaitsFor::kNothing) co_return work();
  asio::thread_pool& pool = waits_for == WaitsFor::kStore ? threads.store : threads.uploads;
  // Asio 1.74 wants a value that can be made out of nothing.
  using Value = std::invoke_result_t<Work>;
  const auto on_thread = [&work]() -> asio::awaitable<std::optional<Value>> { co_return work(); };
  std::optional<Value> value =
      co_await asio::co_spawn(pool.get_executor(), on_thread, asio::use_awaitable);
  co_return *std::move(value);
}

}  // namespace farhorizon
