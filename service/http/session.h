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
#include "service/http/access_rules.h"
#include "service/http/server.h"
#include "service/http/trusted_proxies.h"
#include "service/http/work_threads.h"

namespace farhorizon {

/// What the connections of a server share.
struct SessionContext {
  std::shared_ptr<const ServerOptions> options;  ///< those of when the connection was accepted
  std::shared_ptr<const AccessRules> access;
  std::shared_ptr<const TrustedProxies> proxies;
  const Router& router;
  KeyGate& gate;
  WorkThreads& threads;
  const std::atomic<bool>& stopping;
  /// The server has as many connections as it may: this one may ask for the service's health,
  /// once, and gets 503 for anything else.
  bool surplus = false;
};

/// One connection: request after request, with a deadline on every wait.
/// Threads: runs on the strand of its stream; CloseIfIdle and Close are safe from any thread.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(const SessionContext& context, beast::tcp_stream stream, std::string peer);

  asio::awaitable<void> Run();

  [[nodiscard]] beast::tcp_stream::executor_type executor() { return stream_.get_executor(); }

  /// Closes if no request is being answered; what waits for something to happen waits no longer.
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
  /// The response, and in `read_whole` whether nothing of the request is left in the socket.
  asio::awaitable<HttpResponse> MakeResponse(HttpRequest& request, bool& read_whole);
  /// Gives the response that `late` has, as soon as it has one.
  asio::awaitable<HttpResponse> WaitFor(std::shared_ptr<LateResponse> late);
  /// Lets `awaited`, and the end of the client, wake this session from now on.
  void ListenTo(Awaited& awaited);
  /// Waits until something wakes this session, at most until `time`.
  asio::awaitable<void> Sleep(std::chrono::steady_clock::time_point time);
  void Wake();
  [[nodiscard]] bool MayWait() const { return !peer_gone_ && !context_.stopping; }
  /// Gives the body to `exchange`. The response that refuses the request, if there was an error.
  asio::awaitable<std::optional<HttpResponse>> ReadBody(const HttpRequest& request,
                                                        Exchange& exchange);
  /// Sends `problem` as the last response of the connection.
  asio::awaitable<void> SendLast(const Problem& problem);
  asio::awaitable<bool> Send(const HttpRequest& request, const HttpResponse& response,
                             bool keep_alive);
  asio::awaitable<bool> SendFile(const FileBody& file, const std::string& request_id);
  asio::awaitable<bool> SendEvents(EventSource& events, bool chunked);
  asio::awaitable<bool> SendText(std::string_view text);
  /// Reads on for a moment: to close while the client still sends would reset the connection, and
  /// the response could be lost on its way.
  asio::awaitable<void> Linger();

  SessionContext context_;
  beast::tcp_stream stream_;
  asio::steady_timer deadline_;
  bool late_ = false;
  asio::steady_timer alarm_;  ///< of Sleep
  bool woken_ = false;
  bool peer_gone_ = false;
  std::chrono::steady_clock::duration slept_{};  ///< while the current request was answered
  std::string peer_;
  beast::flat_buffer buffer_;
  bool idle_ = true;
};

}  // namespace farhorizon
