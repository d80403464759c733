// The deadlines of a connection: a head must arrive within a time, a body at a least rate, and the
// client must take the response.
#include "service/http/session.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <memory>
#include <utility>
#include <variant>

#include "service/handlers/problem.h"
#include "service/http/request_head.h"
#include "service/http/response_head.h"
#include "service/log.h"

namespace farhorizon {

namespace {

using Clock = std::chrono::steady_clock;
using boost::system::error_code;

constexpr std::size_t kPieceBytes = 65536;
constexpr std::size_t kLingerBytes = std::size_t{1} << 20U;
constexpr std::chrono::seconds kLingerTime{2};

auto Into(error_code& failure) { return asio::redirect_error(asio::use_awaitable, failure); }

// A head for Beast to frame the body by. The client's own head is read by ReadRequestHead alone;
// Beast gets the one field that decides where the body ends [RFC 9112, section 6.3], as it was
// established there. Two readers of one head could disagree about the end of the body, and part of
// it could pass for a request (section 11.2).
std::string FramingHead(const HttpRequest& request) {
  return "POST / HTTP/1.1\r\n" +
         (request.chunked ? std::string("Transfer-Encoding: chunked")
                          : "Content-Length: " + std::to_string(*request.content_length)) +
         "\r\n\r\n";
}

}  // namespace

asio::awaitable<void> Session::Run() {
  const auto self = shared_from_this();
  for (bool first = true;; first = false) {
    WaitUntil(Clock::now() + (first ? context_.options.head_time : context_.options.idle_time));
    const std::optional<std::string> head = co_await ReadHeadBytes();
    if (!head) break;
    idle_ = false;
    std::variant<HttpRequest, Problem> read = ReadRequestHead(*head, {});
    if (const Problem* problem = std::get_if<Problem>(&read)) {
      co_await SendLast(*problem);
      break;
    }
    HttpRequest& request = std::get<HttpRequest>(read);
    request.peer = peer_;
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

asio::awaitable<void> Session::Refuse() {
  const auto self = shared_from_this();
  const Problem problem("too-many-connections", "there are too many connections; try again soon");
  co_await SendLast(problem);
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
    if (end != std::string_view::npos && end + 4 <= context_.options.max_head_bytes) {
      std::string head(have.substr(0, end + 4));
      buffer_.consume(end + 4);
      co_return head;
    }
    if (have.size() >= context_.options.max_head_bytes) {
      const Problem problem("head-too-large", "the request's head has more than " +
                                                  std::to_string(context_.options.max_head_bytes) +
                                                  " bytes");
      co_await SendLast(problem);
      co_return std::nullopt;
    }
    // From its first byte on, the whole head has to arrive within its time.
    if (!begun && !have.empty()) {
      WaitUntil(Clock::now() + context_.options.head_time);
      begun = true;
    }
    if (context_.stopping && have.empty()) co_return std::nullopt;
    error_code failure;
    const auto space = buffer_.prepare(4096);
    const std::size_t size = co_await stream_.async_read_some(space, Into(failure));
    buffer_.commit(size);
    if (failure && late_ && buffer_.size() > 0) {
      const HttpRequest none;
      const HttpResponse response =
          ProblemResponse(none, {"request-timeout", "the request's head came too slowly"});
      co_await Send(none, response, false);
    }
    if (failure) co_return std::nullopt;
  }
}

asio::awaitable<Session::Next> Session::Answer(HttpRequest request) {
  const Clock::time_point start = Clock::now();
  HttpResponse response;
  bool read_whole = true;  // nothing of the request is left in the socket
  {
    // The exchange, and with it the spooled body, is gone before the client has the response.
    Admission admission = context_.router.Begin(request);
    if (HttpResponse* early = std::get_if<HttpResponse>(&admission)) {
      read_whole = !request.HasBody();
      response = std::move(*early);
    } else {
      Exchange& exchange = *std::get<std::unique_ptr<Exchange>>(admission);
      std::optional<HttpResponse> refusal = co_await ReadBody(request, exchange);
      read_whole = !refusal;
      // Not by ?: with co_await in one arm: g++ 12 destroys the response twice.
      if (read_whole) {
        response = co_await Finish(request, exchange);
      } else {
        response = *std::move(refusal);
      }
    }
  }
  const bool keep_alive = read_whole && request.keep_alive && !context_.stopping;
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
  if (sent && !read_whole) co_await Linger();
  co_return sent&& keep_alive ? Next::kKeepAlive : Next::kClose;
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
  http::request_parser<http::buffer_body> parser;
  parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // none is 0 in Beast 1.74
  parser.header_limit(static_cast<std::uint32_t>(context_.options.max_head_bytes));
  error_code failure;
  parser.put(asio::buffer(FramingHead(request)), failure);
  Check(!failure && parser.is_header_done(), "Beast reads a head of ours");
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
      co_return ProblemResponse(request, {"request-timeout", "the body came too slowly"});
    }
    if (failure) {
      co_return ProblemResponse(request, {"bad-request", "the body is broken off or ill framed"});
    }
    const std::size_t size = piece.size() - parser.get().body().size;
    received += static_cast<std::int64_t>(size);
    const Status taken = exchange.Take({piece.data(), size});
    if (!taken) co_return ProblemResponse(request, ProblemOf(taken.error()));
  }
  co_return std::nullopt;
}

asio::awaitable<HttpResponse> Session::Finish(const HttpRequest& request, Exchange& exchange) {
  const auto work = [&request, &exchange]() -> asio::awaitable<HttpResponse> {
    co_return FinishExchange(exchange, request);
  };
  HttpResponse response =
      co_await asio::co_spawn(context_.handlers.get_executor(), work, asio::use_awaitable);
  co_return response;
}

asio::awaitable<void> Session::SendLast(const Problem& problem) {
  const HttpRequest none;
  const HttpResponse response = ProblemResponse(none, problem);
  const bool sent = co_await Send(none, response, false);
  if (sent) co_await Linger();
}

asio::awaitable<bool> Session::Send(const HttpRequest& request, const HttpResponse& response,
                                    bool keep_alive) {
  std::string text = ResponseHead(request, response, keep_alive, context_.options.cors_origin);
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
  for (std::int64_t sent = 0; sent < file.bytes;) {
    const std::int64_t most =
        std::min<std::int64_t>(file.bytes - sent, static_cast<std::int64_t>(kPieceBytes));
    const Result<std::string_view> piece = file.source->Read(file.offset + sent, most);
    if (!piece) co_return false;
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
  for (std::size_t total = 0; !failure && total < kLingerBytes;) {
    total += co_await stream_.async_read_some(asio::buffer(unread), Into(failure));
  }
}

}  // namespace farhorizon
