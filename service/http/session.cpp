// The deadlines of a connection: a head must arrive within a time, a body at a least rate, and the
// client must take the response.
#include "service/http/session.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <utility>
#include <variant>

#include "service/handlers/problem.h"
#include "service/http/body_reader.h"
#include "service/http/request_head.h"
#include "service/http/request_ids.h"
#include "service/http/request_log.h"
#include "service/http/response_head.h"
#include "service/log.h"
#include "service/metrics.h"

namespace farhorizon {

namespace {

using Clock = std::chrono::steady_clock;
using boost::system::error_code;

constexpr std::size_t kLingerBytes = std::size_t{1} << 20U;
constexpr std::chrono::seconds kLingerTime{2};
// Beyond as much a sender that does not listen is made to wait: nginx looks for the response only
// when it cannot send, and answers 502 where the connection breaks before.
constexpr std::size_t kLingerAtOnce = std::size_t{1} << 18U;
constexpr std::chrono::milliseconds kLingerPause{10};

// A surplus connection is there to ask for the service's health: a head comes at once.
constexpr std::chrono::seconds kSurplusTime{2};

}  // namespace

Session::Session(const SessionContext& context, beast::tcp_stream stream, std::string peer)
    : context_(context),
      stream_(std::move(stream)),
      deadline_(stream_.get_executor()),
      alarm_(stream_.get_executor()),
      peer_(std::move(peer)),
      // Room for a head beside a piece of a body: Beast keeps a chunk's head and the trailers in
      // it until they are whole.
      buffer_(context.options->max_head_bytes + kBodyPieceBytes) {}

asio::awaitable<void> Session::Run() {
  const auto self = shared_from_this();
  const ServerOptions& options = *context_.options;
  const auto head_time = context_.surplus ? kSurplusTime : options.head_time;
  for (bool first = true;; first = false) {
    WaitUntil(Clock::now() + (first ? head_time : options.idle_time));
    const std::optional<std::string> head = co_await ReadHeadBytes();
    if (!head) break;
    idle_ = false;
    std::variant<HttpRequest, Problem> read = ReadRequestHead(*head, {});
    if (const Problem* problem = std::get_if<Problem>(&read)) {
      co_await SendLast(*problem);
      break;
    }
    HttpRequest& request = std::get<HttpRequest>(read);
    request.peer = context_.proxies->ClientOf(request, peer_);
    request.request_id = RequestIdOf(request);
    const Next next = co_await Answer(std::move(request));
    if (next == Next::kClose) break;
    idle_ = true;
  }
  error_code ignored;
  stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
  stream_.close();
  deadline_.cancel();
}

// The deadlines of beast::tcp_stream would close the socket, and no 408 could be sent.
void Session::WaitUntil(std::chrono::steady_clock::time_point time) {
  late_ = false;
  deadline_.expires_at(time);
  deadline_.async_wait([self = shared_from_this()](const error_code& moved) {
    // The deadline may have been moved after this handler was queued.
    if (moved || Clock::now() < self->deadline_.expiry()) return;
    self->late_ = true;
    error_code ignored;
    self->stream_.socket().cancel(ignored);
  });
}

void Session::CloseIfIdle() {
  asio::post(stream_.get_executor(), [self = shared_from_this()] {
    if (self->idle_) self->stream_.close();
    self->Wake();
  });
}

void Session::Close() {
  asio::post(stream_.get_executor(), [self = shared_from_this()] { self->stream_.close(); });
}

asio::awaitable<std::optional<std::string>> Session::ReadHeadBytes() {
  bool begun = false;
  for (;;) {
    const auto data = buffer_.cdata();
    const std::string_view have(static_cast<const char*>(data.data()), data.size());
    // [RFC 9112, section 2.2]: a client may send one empty line too many after a body.
    if (have.substr(0, 2) == "\r\n") {
      buffer_.consume(2);
      if (begun) co_return std::nullopt;
      begun = true;
      continue;
    }
    const std::size_t end = have.find("\r\n\r\n");
    if (end != std::string_view::npos && end + 4 <= context_.options->max_head_bytes) {
      std::string head(have.substr(0, end + 4));
      buffer_.consume(end + 4);
      co_return head;
    }
    if (have.size() >= context_.options->max_head_bytes) {
      const Problem problem("head-too-large", "the request's head has more than " +
                                                  std::to_string(context_.options->max_head_bytes) +
                                                  " bytes");
      co_await SendLast(problem);
      co_return std::nullopt;
    }
    // From its first byte on, the whole head has to arrive within its time.
    if (!begun && !have.empty()) {
      WaitUntil(Clock::now() + context_.options->head_time);
      begun = true;
    }
    if (context_.stopping && have.empty()) co_return std::nullopt;
    error_code failure;
    const auto space = buffer_.prepare(4096);
    const std::size_t size = co_await stream_.async_read_some(space, Into(failure));
    buffer_.commit(size);
    if (failure && late_ && buffer_.size() > 0) {
      co_await SendLast({"request-timeout", "the request's head came too slowly"});
    }
    if (failure) co_return std::nullopt;
  }
}

asio::awaitable<Session::Next> Session::Answer(HttpRequest request) {
  const Clock::time_point start = Clock::now();
  bool read_whole = true;
  slept_ = {};
  HttpResponse response = co_await MakeResponse(request, read_whole);
  if (response.late) response = co_await WaitFor(response.late);
  const bool keep_alive = read_whole && request.keep_alive && !context_.stopping &&
                          !context_.surplus && !response.events;
  const bool sent = co_await Send(request, response, keep_alive);
  const Clock::duration took = Clock::now() - start;
  CountRequest(request.method, request.route, response.status, took - slept_);
  LogRequest(request, response, took);
  if (sent && !read_whole) co_await Linger();
  co_return sent&& keep_alive ? Next::kKeepAlive : Next::kClose;
}

asio::awaitable<HttpResponse> Session::MakeResponse(HttpRequest& request, bool& read_whole) {
  read_whole = !request.HasBody();
  if (const auto problem = CheckAccess(request, *context_.access)) {
    co_return ProblemResponse(request, *problem);
  }
  const Route* route = context_.router.Find(request);
  const WaitsFor waits_for = route == nullptr ? WaitsFor::kNothing : route->waits_for;
  if (context_.surplus && waits_for != WaitsFor::kNothing) {
    co_return ProblemResponse(
        request, {"too-many-connections", "there are too many connections; try again soon"});
  }
  if (std::optional<HttpResponse> refusal = context_.gate.Admit(request, route)) {
    co_return *std::move(refusal);
  }
  // What decides on a request looks into the store and makes a file, but waits for no process.
  const WaitsFor begin_waits = std::min(waits_for, WaitsFor::kStore);
  Admission admission = co_await RunOn(context_.threads, begin_waits,
                                       [&] { return context_.router.Begin(route, request); });
  if (HttpResponse* early = std::get_if<HttpResponse>(&admission)) co_return std::move(*early);
  // The exchange, and with it the spooled body, is gone before the client has the response.
  Exchange& exchange = *std::get<std::unique_ptr<Exchange>>(admission);
  std::optional<HttpResponse> refusal = co_await ReadBody(request, exchange);
  read_whole = !refusal;
  if (refusal) {
    co_await RunOn(context_.threads, WaitsFor::kStore, [&] {
      AbandonExchange(exchange, request);
      return true;
    });
  }
  // Not by ?: with co_await in one arm: g++ 12 destroys the response twice.
  if (refusal) co_return *std::move(refusal);
  co_return co_await RunOn(context_.threads, waits_for,
                           [&] { return FinishExchange(exchange, request); });
}

asio::awaitable<std::optional<HttpResponse>> Session::ReadBody(const HttpRequest& request,
                                                               Exchange& exchange) {
  if (!request.HasBody()) co_return std::nullopt;
  if (request.expects_continue) {
    const bool sent = co_await SendText("HTTP/1.1 100 Continue\r\n\r\n");
    if (!sent) {
      co_return ProblemResponse(request, {"request-timeout", "the client took no 100 Continue"});
    }
  }
  const ServerOptions& options = *context_.options;
  BodyReader reader(request, options.max_head_bytes);
  const Clock::time_point start = Clock::now();
  while (!reader.done()) {
    const auto earned = std::chrono::seconds(reader.received() / options.body_bytes_per_second);
    const auto silent = Clock::now() + options.idle_time;
    WaitUntil(std::min<Clock::time_point>(start + options.body_grace + earned, silent));
    error_code failure;
    const std::string_view piece = co_await reader.ReadSome(stream_, buffer_, failure);
    if (failure && late_) {
      co_return ProblemResponse(request, {"request-timeout", "the body came too slowly"});
    }
    if (failure) co_return ProblemResponse(request, ProblemOfBody(failure));
    if (piece.empty()) continue;
    const Status taken =
        co_await RunOn(context_.threads, WaitsFor::kStore, [&] { return exchange.Take(piece); });
    context_.gate.CountUpload(request, static_cast<std::int64_t>(piece.size()));
    if (!taken) co_return ProblemResponse(request, ProblemOf(taken.error()));
  }
  co_return std::nullopt;
}

asio::awaitable<void> Session::SendLast(const Problem& problem) {
  HttpRequest none;
  none.peer = peer_;
  none.request_id = RequestIdOf(none);
  const HttpResponse response = ProblemResponse(none, problem);
  const bool sent = co_await Send(none, response, false);
  CountRequest(none.method, none.route, response.status, {});
  LogRequest(none, response, {});
  if (sent) co_await Linger();
}

asio::awaitable<bool> Session::Send(const HttpRequest& request, const HttpResponse& response,
                                    bool keep_alive) {
  std::string text = ResponseHead(request, response, keep_alive, CorsOf(request, *context_.access));
  const bool has_body =
      request.method != "HEAD" && response.status != 204 && response.status != 304;
  if (has_body && !response.file) text += response.body;
  bool sent = co_await SendText(text);
  if (sent && has_body && response.events) {
    sent = co_await SendEvents(*response.events, request.version != 10);
  }
  if (sent && has_body && response.file)
    sent = co_await SendFile(*response.file, request.request_id);
  co_return sent;
}

asio::awaitable<bool> Session::SendText(std::string_view text) {
  while (!text.empty()) {
    error_code failure;
    WaitUntil(Clock::now() + context_.options->write_time);
    const std::string_view piece = text.substr(0, kBodyPieceBytes);
    co_await asio::async_write(stream_, asio::buffer(piece.data(), piece.size()), Into(failure));
    if (failure) co_return false;
    text.remove_prefix(piece.size());
  }
  co_return true;
}

asio::awaitable<bool> Session::SendFile(const FileBody& file, const std::string& request_id) {
  for (std::int64_t sent = 0; sent < file.bytes;) {
    const std::int64_t most =
        std::min<std::int64_t>(file.bytes - sent, static_cast<std::int64_t>(kBodyPieceBytes));
    const Result<std::string_view> piece = co_await RunOn(context_.threads, WaitsFor::kStore, [&] {
      return file.source->Read(file.offset + sent, most);
    });
    if (!piece) {
      // The head has been sent: all that is left is to end the connection.
      Log(LogLevel::kWarning, "answer cut off",
          {{"request_id", request_id}, {"bytes", sent}, {"error", piece.error().message}});
      co_return false;
    }
    const bool taken = co_await SendText(*piece);
    if (!taken) co_return false;
    sent += static_cast<std::int64_t>(piece->size());
  }
  co_return true;
}

asio::awaitable<void> Session::Linger() {
  error_code failure;
  stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, failure);
  WaitUntil(Clock::now() + kLingerTime);
  std::array<char, 8192> unread{};
  asio::steady_timer pause(stream_.get_executor());
  for (std::size_t total = 0; !failure && !late_ && total < kLingerBytes;) {
    total += co_await stream_.async_read_some(asio::buffer(unread), Into(failure));
    if (failure || total < kLingerAtOnce) continue;
    pause.expires_after(kLingerPause);
    co_await pause.async_wait(Into(failure));
  }
}

}  // namespace farhorizon
