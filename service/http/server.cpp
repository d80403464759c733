#include "service/http/server.h"

#include <charconv>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "service/http/session.h"
#include "service/log.h"

namespace farhorizon {

namespace {

using asio::ip::tcp;
using boost::system::error_code;

constexpr std::chrono::milliseconds kAcceptPause{100};

class AsioServer : public Server {
 public:
  explicit AsioServer(const ServerOptions& options)
      : options_(options),
        acceptor_(asio::make_strand(context_)),
        handlers_(static_cast<std::size_t>(options.handler_threads)) {}
  ~AsioServer() override { AsioServer::Stop(std::chrono::milliseconds(0)); }

  Status Open();
  [[nodiscard]] std::uint16_t port() const override { return acceptor_.local_endpoint().port(); }
  void Serve(const Router& router) override;
  void Stop(std::chrono::milliseconds most) override;

 private:
  asio::awaitable<void> Accept(const Router& router);
  void Begin(const Router& router, tcp::socket socket);
  void End(const std::shared_ptr<Session>& session, const std::string& peer);

  ServerOptions options_;
  asio::io_context context_;
  tcp::acceptor acceptor_;
  asio::thread_pool handlers_;
  std::vector<std::thread> threads_;
  std::atomic<bool> stopping_{false};

  std::mutex mutex_;
  std::condition_variable ended_;
  std::set<std::shared_ptr<Session>> sessions_;
  std::map<std::string, int> by_address_;
};

Status AsioServer::Open() {
  const auto cannot = [&](const error_code& failure) {
    return Error{ErrorCode::kIo,
                 "cannot listen on " + options_.host + ":" + std::to_string(options_.port) + ": " +
                     failure.message() + "; give another --listen HOST:PORT",
                 "cannot-listen"};
  };
  error_code failure;
  tcp::resolver resolver(context_);
  const auto found = resolver.resolve(options_.host, std::to_string(options_.port),
                                      tcp::resolver::passive, failure);
  if (failure || found.empty()) return cannot(failure);
  const tcp::endpoint endpoint = found.begin()->endpoint();
  acceptor_.open(endpoint.protocol(), failure);
  if (!failure) acceptor_.set_option(tcp::acceptor::reuse_address(true), failure);
  if (!failure) acceptor_.bind(endpoint, failure);
  if (!failure) acceptor_.listen(asio::socket_base::max_listen_connections, failure);
  if (failure) return cannot(failure);
  return Ok{};
}

void AsioServer::Serve(const Router& router) {
  asio::co_spawn(acceptor_.get_executor(), Accept(router), asio::detached);
  for (int i = 0; i < options_.io_threads; ++i) {
    threads_.emplace_back([this] { context_.run(); });
  }
}

asio::awaitable<void> AsioServer::Accept(const Router& router) {
  while (!stopping_) {
    error_code failure;
    tcp::socket socket = co_await acceptor_.async_accept(
        asio::make_strand(context_), asio::redirect_error(asio::use_awaitable, failure));
    if (failure == asio::error::operation_aborted || !acceptor_.is_open()) break;
    // Such as: the process has no descriptors left. A pause lets some connections end.
    if (failure) {
      Log(LogLevel::kWarning, "cannot accept", {{"error", failure.message()}});
      asio::steady_timer pause(acceptor_.get_executor(), kAcceptPause);
      co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, failure));
      continue;
    }
    Begin(router, std::move(socket));
  }
}

void AsioServer::Begin(const Router& router, tcp::socket socket) {
  error_code failure;
  const std::string peer = socket.remote_endpoint(failure).address().to_string();
  if (failure) return;
  socket.set_option(tcp::no_delay(true), failure);
  const SessionContext context{options_, router, handlers_, stopping_};
  const auto session =
      std::make_shared<Session>(context, beast::tcp_stream(std::move(socket)), peer);
  bool full = false;
  {
    const std::lock_guard lock(mutex_);
    const int from_there = ++by_address_[peer];
    sessions_.insert(session);
    full = static_cast<int>(sessions_.size()) > options_.max_connections ||
           from_there > options_.max_connections_per_address;
    if (static_cast<int>(sessions_.size()) > 2 * options_.max_connections) {
      // With so many connections even the answers 503 would cost too much.
      sessions_.erase(session);
      if (--by_address_[peer] == 0) by_address_.erase(peer);
      return;
    }
  }
  const auto done = [this, session, peer](const std::exception_ptr& bug) {
    if (bug) Log(LogLevel::kError, "a connection ended in an exception", {{"peer", peer}});
    End(session, peer);
  };
  asio::co_spawn(session->executor(), full ? session->Refuse() : session->Run(), done);
}

void AsioServer::End(const std::shared_ptr<Session>& session, const std::string& peer) {
  const std::lock_guard lock(mutex_);
  sessions_.erase(session);
  if (--by_address_[peer] == 0) by_address_.erase(peer);
  ended_.notify_all();
}

void AsioServer::Stop(std::chrono::milliseconds most) {
  if (!stopping_.exchange(true)) {
    asio::post(acceptor_.get_executor(), [this] {
      error_code ignored;
      acceptor_.close(ignored);
    });
  }
  if (!threads_.empty()) {
    std::unique_lock lock(mutex_);
    for (const auto& session : sessions_) session->CloseIfIdle();
    const auto none = [this] { return sessions_.empty(); };
    if (!ended_.wait_for(lock, most, none)) {
      for (const auto& session : sessions_) session->Close();
      ended_.wait_for(lock, std::chrono::seconds(1), none);
    }
  }
  handlers_.join();
  context_.stop();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

}  // namespace

Result<std::unique_ptr<Server>> Server::Bind(const ServerOptions& options) {
  auto server = std::make_unique<AsioServer>(options);
  Status opened = server->Open();
  if (!opened) return std::move(opened.error());
  return std::unique_ptr<Server>(std::move(server));
}

Result<HostPort> ReadHostPort(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  HostPort address;
  bool sound = colon != std::string::npos && colon > 0 && colon + 1 < text.size();
  if (sound) {
    address.host = text.substr(0, colon);
    const char* end = text.data() + text.size();
    sound = std::from_chars(text.data() + colon + 1, end, address.port).ptr == end;
    const bool bracketed = address.host.front() == '[' && address.host.back() == ']';
    if (bracketed) address.host = address.host.substr(1, address.host.size() - 2);
    sound = sound && (bracketed || address.host.find(':') == std::string::npos);
  }
  if (sound) return address;
  return Error{ErrorCode::kInvalidArgument,
               "\"" + text + "\" is no HOST:PORT; write 127.0.0.1:8080 or [::1]:8080",
               "invalid-address"};
}

}  // namespace farhorizon
