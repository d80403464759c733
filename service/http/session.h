#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "service/asio.h"
#include "service/handlers/problem.h"
#include "service/handlers/router.h"
#include "service/http/server.h"

namespace farhorizon {

/// What every connection of a server shares.
struct SessionContext {
  const ServerOptions& options;
  const Router& router;
  asio::thread_pool& handlers;
  const std::atomic<bool>& stopping;
};

/// One connection: request after request, with a deadline on every wait.
/// Threads: runs on the strand of its stream; CloseIfIdle and Close are safe from any thread.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(const SessionContext& context, beast::tcp_stream stream, std::string peer)
      : context_(context),
        stream_(std::move(stream)),
        deadline_(stream_.get_executor()),
        peer_(std::move(peer)) {}

  asio::awaitable<void> Run();
  /// Answers 503 "too-many-connections" and closes.
  asio::awaitable<void> Refuse();

  [[nodiscard]] beast::tcp_stream::executor_type executor() { return stream_.get_executor(); }

  /// Closes if no request is being answered.
  void CloseIfIdle();
  /// Closes at once.
  void Close();

 private:
  enum class Next { kKeepAlive, kClose };

  /// Sets the deadline of the next wait on the stream. A wait that is late fails, and late_ is
  /// true.
  void WaitUntil(std::chrono::steady_clock::time_point time);
  /// The next head, with its closing empty line. nullopt if the connection is to be closed; the
  /// client has been told why if it could be.
  asio::awaitable<std::optional<std::string>> ReadHeadBytes();
  asio::awaitable<Next> Answer(HttpRequest request);
  /// Gives the body to `exchange`. The response that refuses the request, if there was an error;
  /// then some of the request may be left in the socket.
  asio::awaitable<std::optional<HttpResponse>> ReadBody(const HttpRequest& request,
                                                        Exchange& exchange);
  /// Finishes on the threads for handlers, which wait for disk and database.
  asio::awaitable<HttpResponse> Finish(const HttpRequest& request, Exchange& exchange);
  /// Sends `problem` as the last response of the connection.
  asio::awaitable<void> SendLast(const Problem& problem);
  asio::awaitable<bool> Send(const HttpRequest& request, const HttpResponse& response,
                             bool keep_alive);
  asio::awaitable<bool> SendFile(const FileBody& file);
  asio::awaitable<bool> SendText(std::string_view text);
  /// Reads on for a moment: to close while the client still sends would reset the connection, and
  /// the response could be lost on its way.
  asio::awaitable<void> Linger();

  SessionContext context_;
  beast::tcp_stream stream_;
  asio::steady_timer deadline_;
  bool late_ = false;
  std::string peer_;
  beast::flat_buffer buffer_;
  bool idle_ = true;
};

}  // namespace farhorizon
