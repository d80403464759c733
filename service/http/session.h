#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "service/asio.h"
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

/// One connection: request after request, each through the gate, with a deadline on every wait.
/// Runs on the strand of its stream.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(const SessionContext& context, beast::tcp_stream stream, std::string peer)
      : context_(context),
        stream_(std::move(stream)),
        deadline_(stream_.get_executor()),
        peer_(std::move(peer)) {}

  asio::awaitable<void> Run();
  /// Says 503 and closes: there are too many connections.
  asio::awaitable<void> Refuse();

  [[nodiscard]] beast::tcp_stream::executor_type executor() { return stream_.get_executor(); }

  /// Closes if no request is being answered. From any thread.
  void CloseIfIdle();
  /// Closes whatever goes on. From any thread.
  void Close();

 private:
  enum class Next { kKeepAlive, kClose };

  /// Sets the one deadline that every wait of this connection has.
  void WaitUntil(std::chrono::steady_clock::time_point time);
  asio::awaitable<bool> ReadHeadBytes(std::string& head);
  asio::awaitable<Next> Exchange(HttpRequest request, const std::string& head);
  asio::awaitable<HttpResponse> ReadBody(const HttpRequest& request, const std::string& head,
                                         BodySink& sink, bool& whole);
  asio::awaitable<HttpResponse> Handle(const HttpRequest& request, BodySink* sink);
  asio::awaitable<bool> Send(const HttpRequest& request, const HttpResponse& response,
                             bool keep_alive);
  asio::awaitable<bool> SendFile(const FileBody& file);
  asio::awaitable<bool> SendText(std::string_view text);
  asio::awaitable<void> Linger();
  [[nodiscard]] std::string ResponseHead(const HttpRequest& request, const HttpResponse& response,
                                         bool keep_alive) const;

  SessionContext context_;
  beast::tcp_stream stream_;
  asio::steady_timer deadline_;
  bool late_ = false;
  std::string peer_;
  beast::flat_buffer buffer_;
  bool idle_ = true;
};

}  // namespace farhorizon
