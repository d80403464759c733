// What a session waits for beside its socket: that something happens to a job. It has no thread
// meanwhile, and sees when its client goes away.
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <sys/socket.h>

#include "service/http/session.h"

namespace farhorizon {

namespace {

using Clock = std::chrono::steady_clock;
using asio::ip::tcp;
using boost::system::error_code;

// So that proxies do not take a stream of events for dead, and nor does the session a client.
constexpr std::chrono::seconds kHeartbeat{15};
constexpr std::string_view kComment = ":\n\n";

}  // namespace

asio::awaitable<HttpResponse> Session::WaitFor(std::shared_ptr<LateResponse> late) {
  const Clock::time_point end = Clock::now() + late->Most();
  ListenTo(*late);
  for (;;) {
    woken_ = false;
    const bool last = !MayWait() || Clock::now() >= end;
    std::unique_ptr<HttpResponse> response =
        co_await RunOn(context_.threads, WaitsFor::kStore, [&] { return late->Try(last); });
    if (response) {
      error_code ignored;
      stream_.socket().cancel(ignored);  // the wait for the client's end
      co_return std::move(*response);
    }
    co_await Sleep(end);
  }
}

void Session::ListenTo(Awaited& awaited) {
  // The deadline of an earlier wait would end that for the client's end.
  deadline_.cancel();
  const std::weak_ptr<Session> weak = weak_from_this();
  awaited.Listen([weak, executor = stream_.get_executor()] {
    asio::post(executor, [weak] {
      if (const auto self = weak.lock()) self->Wake();
    });
  });
  stream_.socket().async_wait(
      tcp::socket::wait_read, [self = shared_from_this()](const error_code& failure) {
        const bool open = self->stream_.socket().is_open();
        if (failure && open) return;  // cancelled: nobody waits any more
        char next = 0;
        const ssize_t size =
            open ? ::recv(self->stream_.socket().native_handle(), &next, 1, MSG_PEEK | MSG_DONTWAIT)
                 : 0;
        // A client may send its next request before it has the response to this one.
        if (size == 0 || (size < 0 && errno != EAGAIN)) self->peer_gone_ = true;
        self->Wake();
      });
}

asio::awaitable<void> Session::Sleep(Clock::time_point time) {
  const Clock::time_point start = Clock::now();
  if (!woken_ && MayWait()) {
    error_code ignored;
    alarm_.expires_at(time);
    co_await alarm_.async_wait(Into(ignored));
  }
  slept_ += Clock::now() - start;
}

void Session::Wake() {
  woken_ = true;
  alarm_.cancel();
}

asio::awaitable<bool> Session::SendEvents(EventSource& events, bool chunked) {
  const auto framed = [chunked](std::string_view text) {
    if (!chunked || text.empty()) return std::string(text);
    std::array<char, 16> size{};
    const auto end = std::to_chars(size.data(), size.data() + size.size(), text.size(), 16).ptr;
    return std::string(size.data(), end).append("\r\n").append(text).append("\r\n");
  };
  ListenTo(events);
  Clock::time_point said = Clock::now();
  for (;;) {
    woken_ = false;
    EventSource::Piece piece =
        co_await RunOn(context_.threads, WaitsFor::kStore, [&events] { return events.Next(); });
    if (piece.text.empty() && Clock::now() >= said + kHeartbeat) piece.text = kComment;
    if (!piece.text.empty()) {
      said = Clock::now();
      const std::string frame = framed(piece.text);
      const bool taken = co_await SendText(frame);
      if (!taken) co_return false;
      deadline_.cancel();
    }
    if (piece.last || !MayWait()) break;
    co_await Sleep(said + kHeartbeat);
  }
  if (peer_gone_) co_return false;
  // Not by ?: with co_await in one arm, as above.
  if (!chunked) co_return true;
  co_return co_await SendText("0\r\n\r\n");
}

}  // namespace farhorizon
