// A connection's life. Every wait has a deadline: a head must come within a time, a body at a least
// rate, an answer must be taken.
#include "service/http/session.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <optional>
#include <unistd.h>
#include <variant>

#include "service/clock.h"
#include "service/handlers/problem.h"
#include "service/http/gate.h"
#include "service/log.h"

namespace farhorizon {

namespace {

using Clock = std::chrono::steady_clock;
using boost::system::error_code;

constexpr std::size_t kPieceBytes = 65536;
constexpr std::size_t kLingerBytes = std::size_t{1} << 20U;
constexpr std::chrono::seconds kLingerTime{2};

auto Into(error_code& failure) { return asio::redirect_error(asio::use_awaitable, failure); }

}  // namespace

asio::awaitable<void> Session::Run() {
  const auto self = shared_from_this();
  for (bool first = true;; first = false) {
    WaitUntil(Clock::now() + (first ? context_.options.head_time : context_.options.idle_time));
    std::string head;
    const bool whole = co_await ReadHeadBytes(head);
    if (!whole) break;
    idle_ = false;
    std::variant<HttpRequest, Problem> read = ReadHead(head, {});
    if (const Problem* problem = std::get_if<Problem>(&read)) {
      const HttpRequest none;
      const HttpResponse response = ProblemResponse(none, *problem);
      const bool sent = co_await Send(none, response, false);
      if (sent) co_await Linger();
      break;
    }
    HttpRequest& request = std::get<HttpRequest>(read);
    request.peer = peer_;
    const Next next = co_await Exchange(std::move(request), head);
    if (next == Next::kClose) break;
    idle_ = true;
  }
  error_code ignored;
  stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
  stream_.close();
  deadline_.cancel();
}

/// What waits on the stream then fails, and late_ tells why. (The deadlines of beast::tcp_stream
/// close the socket: no 408 could be sent.)
void Session::WaitUntil(std::chrono::steady_clock::time_point time) {
  late_ = false;
  deadline_.expires_at(time);
  deadline_.async_wait([self = shared_from_this()](const error_code& moved) {
    // Moved while this was under way already: not the present deadline's end.
    if (moved || Clock::now() < self->deadline_.expiry()) return;
    self->late_ = true;
    error_code ignored;
    self->stream_.socket().cancel(ignored);
  });
}

asio::awaitable<void> Session::Refuse() {
  const auto self = shared_from_this();
  const HttpRequest none;
  const HttpResponse response = ProblemResponse(
      none, {503, "too-many-connections", "there are too many connections; try again soon"});
  const bool sent = co_await Send(none, response, false);
  if (sent) co_await Linger();
  stream_.close();
  deadline_.cancel();
}

void Session::CloseIfIdle() {
  asio::post(stream_.get_executor(), [self = shared_from_this()] {
    if (self->idle_) self->stream_.close();
  });
}

void Session::Close() {
  asio::post(stream_.get_executor(), [self = shared_from_this()] { self->stream_.close(); });
}

/// Reads up to the empty line and takes that much out of the buffer. False where the connection is
/// at its end.
asio::awaitable<bool> Session::ReadHeadBytes(std::string& head) {
  bool begun = false;
  for (;;) {
    const auto data = buffer_.cdata();
    const std::string_view have(static_cast<const char*>(data.data()), data.size());
    if (have.substr(0, 2) == "\r\n") {  // RFC 9112, 2.2: one may be left of the request before
      buffer_.consume(2);
      if (begun) co_return false;
      begun = true;
      continue;
    }
    const std::size_t end = have.find("\r\n\r\n");
    if (end != std::string_view::npos && end + 4 <= context_.options.max_head_bytes) {
      head = have.substr(0, end + 4);
      buffer_.consume(end + 4);
      co_return true;
    }
    if (have.size() >= context_.options.max_head_bytes) {
      const HttpRequest none;
      const HttpResponse response =
          ProblemResponse(none, {431, "head-too-large",
                                 "the request's head has more than " +
                                     std::to_string(context_.options.max_head_bytes) + " bytes"});
      const bool sent = co_await Send(none, response, false);
      if (sent) co_await Linger();
      co_return false;
    }
    if (!begun && !have.empty()) {  // the whole head has to come within its time
      WaitUntil(Clock::now() + context_.options.head_time);
      begun = true;
    }
    if (context_.stopping && have.empty()) co_return false;
    error_code failure;
    const auto space = buffer_.prepare(4096);
    const std::size_t size = co_await stream_.async_read_some(space, Into(failure));
    buffer_.commit(size);
    if (failure && late_ && buffer_.size() > 0) {
      const HttpRequest none;
      const HttpResponse response =
          ProblemResponse(none, {408, "request-timeout", "the request's head came too slowly"});
      co_await Send(none, response, false);
      co_return false;
    }
    if (failure) co_return false;
  }
}

asio::awaitable<Session::Next> Session::Exchange(HttpRequest request, const std::string& head) {
  const Clock::time_point start = Clock::now();
  HttpResponse response;
  bool whole = true;  // nothing of the request is left in the socket
  Admission admission = context_.router.Begin(request);
  if (admission.answer) {
    whole = !request.HasBody();
    response = *std::move(admission.answer);
  } else {
    if (admission.sink) {
      response = co_await ReadBody(request, head, *admission.sink, whole);
    }
    if (whole) response = co_await Handle(request, admission.sink.get());
  }
  admission.sink.reset();
  const bool keep_alive = whole && request.keep_alive && !context_.stopping;
  const bool sent = co_await Send(request, response, keep_alive);
  const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start);
  const bool health = request.path == "/healthz" || request.path == "/readyz";
  Log(health ? LogLevel::kDebug : LogLevel::kInfo, "request",
      {{"method", request.method},
       {"path", request.path},
       {"status", std::int64_t{response.status}},
       {"bytes", response.BodyBytes()},
       {"dur_ms", std::int64_t{took.count()}},
       {"peer", peer_}});
  if (sent && !whole) co_await Linger();
  co_return sent&& keep_alive ? Next::kKeepAlive : Next::kClose;
}

/// Feeds the body to `sink`. whole: set to false, and the answer given, where it did not come.
asio::awaitable<HttpResponse> Session::ReadBody(const HttpRequest& request, const std::string& head,
                                                BodySink& sink, bool& whole) {
  whole = true;
  if (!request.HasBody()) co_return HttpResponse{};
  whole = false;
  if (request.expects_continue) {
    const bool sent = co_await SendText("HTTP/1.1 100 Continue\r\n\r\n");
    if (!sent) co_return HttpResponse{};
  }
  http::request_parser<http::buffer_body> parser;
  parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // none is 0 in Beast 1.74
  parser.header_limit(static_cast<std::uint32_t>(context_.options.max_head_bytes));
  error_code failure;
  parser.put(asio::buffer(head), failure);  // the gate has let it in; Beast frames the body
  if (failure) co_return ProblemResponse(request, {400, "bad-request", failure.message()});
  const Clock::time_point start = Clock::now();
  std::int64_t received = 0;
  std::vector<char> piece(kPieceBytes);
  while (!parser.is_done()) {
    parser.get().body() = {piece.data(), piece.size(), true};
    const auto earned = std::chrono::seconds(received / context_.options.body_bytes_per_second);
    WaitUntil(start + context_.options.body_grace + earned);
    co_await http::async_read_some(stream_, buffer_, parser, Into(failure));
    if (failure == http::error::need_buffer) failure = {};
    if (failure && late_) {
      co_return ProblemResponse(request, {408, "request-timeout", "the body came too slowly"});
    }
    if (failure) {
      co_return ProblemResponse(request,
                                {400, "bad-request", "the body is broken off or ill framed"});
    }
    const std::size_t size = piece.size() - parser.get().body().size;
    received += static_cast<std::int64_t>(size);
    Status taken = sink.Write({piece.data(), size});
    if (!taken) co_return ProblemResponse(request, ProblemOf(taken.error()));
  }
  whole = true;
  co_return HttpResponse{};
}

/// Handlers wait for disk and database: on threads of their own.
asio::awaitable<HttpResponse> Session::Handle(const HttpRequest& request, BodySink* sink) {
  const Router& router = context_.router;
  const auto work = [&router, &request, sink]() -> asio::awaitable<HttpResponse> {
    co_return router.Finish(request, sink);
  };
  HttpResponse response =
      co_await asio::co_spawn(context_.handlers.get_executor(), work, asio::use_awaitable);
  co_return response;
}

std::string Session::ResponseHead(const HttpRequest& request, const HttpResponse& response,
                                  bool keep_alive) const {
  std::string head =
      "HTTP/1.1 " + std::to_string(response.status) + " " + ReasonPhrase(response.status) + "\r\n";
  const auto add = [&head](std::string_view name, std::string_view value) {
    head.append(name).append(": ").append(value).append("\r\n");
  };
  for (const auto& [name, value] : response.headers) add(name, value);
  if (response.status != 204 && response.status != 304) {
    add("Content-Length", std::to_string(response.BodyBytes()));
  }
  add("Date", FormatHttpDate(NowMs()));
  add("Connection", keep_alive ? "keep-alive" : "close");
  add("X-Content-Type-Options", "nosniff");
  add("Content-Security-Policy", "default-src 'none'");
  if (!context_.options.cors_origin.empty()) {
    add("Access-Control-Allow-Origin", context_.options.cors_origin);
    add("Access-Control-Expose-Headers",
        "Location, ETag, Link, Retry-After, Content-Range, Accept-Ranges, Repr-Digest");
    if (context_.options.cors_origin != "*") add("Vary", "Origin");
  }
  if (const std::string* id = request.Header("x-request-id"); id != nullptr && id->size() <= 200) {
    add("X-Request-Id", *id);
  }
  return head + "\r\n";
}

asio::awaitable<bool> Session::Send(const HttpRequest& request, const HttpResponse& response,
                                    bool keep_alive) {
  std::string text = ResponseHead(request, response, keep_alive);
  const bool has_body =
      request.method != "HEAD" && response.status != 204 && response.status != 304;
  if (has_body && !response.file) text += response.body;
  bool sent = co_await SendText(text);
  if (sent && has_body && response.file) sent = co_await SendFile(*response.file);
  co_return sent;
}

asio::awaitable<bool> Session::SendText(std::string_view text) {
  while (!text.empty()) {
    error_code failure;
    WaitUntil(Clock::now() + context_.options.write_time);
    const std::string_view piece = text.substr(0, kPieceBytes);
    co_await asio::async_write(stream_, asio::buffer(piece.data(), piece.size()), Into(failure));
    if (failure) co_return false;
    text.remove_prefix(piece.size());
  }
  co_return true;
}

asio::awaitable<bool> Session::SendFile(const FileBody& file) {
  std::vector<char> piece(kPieceBytes);
  for (std::int64_t sent = 0; sent < file.bytes;) {
    const auto wanted = static_cast<std::size_t>(
        std::min<std::int64_t>(file.bytes - sent, static_cast<std::int64_t>(piece.size())));
    const ssize_t size = ::pread(file.fd->get(), piece.data(), wanted, file.offset + sent);
    if (size <= 0) co_return false;  // the client sees a body that is too short, never a wrong one
    const bool taken = co_await SendText({piece.data(), static_cast<std::size_t>(size)});
    if (!taken) co_return false;
    sent += size;
  }
  co_return true;
}

/// Closing while the client still sends would reset the connection and lose the answer on its way.
asio::awaitable<void> Session::Linger() {
  error_code failure;
  stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, failure);
  WaitUntil(Clock::now() + kLingerTime);
  std::array<char, 8192> unread{};
  for (std::size_t total = 0; !failure && total < kLingerBytes;) {
    total += co_await stream_.async_read_some(asio::buffer(unread), Into(failure));
  }
}

}  // namespace farhorizon
