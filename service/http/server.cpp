#include "service/http/server.h"

#include <algorithm>
#include <charconv>
#include <condition_variable>
#include <deque>
#include <future>
#include <map>
#include <mutex>
#include <set>
#include <sys/resource.h>
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
// Connections beyond the limit that may ask for the service's health.
constexpr int kSurplus = 16;
// Descriptors that connections must leave: for libraries, standard streams, the database with its
// journal and index, each thread's spooled upload and opened artifact, the pipes of workers.
constexpr rlim_t kReservedFiles = 32;

// As many descriptors as the system gives this process, at most as many as `options` may use.
rlim_t RaiseFileLimit() {
  struct rlimit limit {};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return 256;
  if (limit.rlim_cur < limit.rlim_max) {
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &limit);
    ::getrlimit(RLIMIT_NOFILE, &limit);
  }
  return limit.rlim_cur;
}

// At most as many connections as leave descriptors to the rest of the process.
int ConnectionsFor(const ServerOptions& options) {
  const auto threads = static_cast<rlim_t>(options.handler_threads + options.upload_threads);
  const rlim_t reserved = kReservedFiles + 2 * threads + kSurplus;
  const rlim_t files = RaiseFileLimit();
  // Each connection has one more: the upload or the artifact that it moves.
  const rlim_t most = files > reserved + 8 ? (files - reserved) / 2 : 4;
  return static_cast<int>(std::min(most, static_cast<rlim_t>(options.max_connections)));
}

class AsioServer : public Server {
 public:
  explicit AsioServer(const ServerOptions& options)
      : first_options_(options), acceptor_(asio::make_strand(context_)), work_(options) {
    AsioServer::Reload(options);
  }
  ~AsioServer() override { AsioServer::Stop(std::chrono::milliseconds(0)); }

  Status Open();
  [[nodiscard]] std::uint16_t port() const override { return acceptor_.local_endpoint().port(); }
  void Reload(const ServerOptions& options) override;
  void Serve(const Router& router, KeyGate& gate) override;
  bool Responds(std::chrono::milliseconds most) override;
  void Stop(std::chrono::milliseconds most) override;

 private:
  asio::awaitable<void> Accept(const Router& router, KeyGate& gate);
  void Begin(const Router& router, KeyGate& gate, tcp::socket socket);
  void End(const std::shared_ptr<Session>& session, const std::string& peer);

  const ServerOptions first_options_;
  asio::io_context context_;
  tcp::acceptor acceptor_;
  WorkThreads work_;
  std::vector<std::thread> threads_;
  std::atomic<bool> stopping_{false};

  std::mutex mutex_;
  std::shared_ptr<const ServerOptions> options_;
  std::shared_ptr<const AccessRules> access_;
  std::shared_ptr<const TrustedProxies> proxies_;
  int max_connections_ = 0;
  std::condition_variable ended_;
  std::set<std::shared_ptr<Session>> sessions_;
  std::deque<std::shared_ptr<Session>> surplus_;  // of them, the oldest first
  std::map<std::string, int> by_address_;
};

Status AsioServer::Open() {
  const auto cannot = [&](const error_code& failure) {
    return Error{ErrorCode::kIo,
                 "cannot listen on " + first_options_.host + ":" +
                     std::to_string(first_options_.port) + ": " + failure.message() +
                     "; give another --listen HOST:PORT",
                 "cannot-listen"};
  };
  error_code failure;
  tcp::resolver resolver(context_);
  const auto found = resolver.resolve(first_options_.host, std::to_string(first_options_.port),
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

void AsioServer::Reload(const ServerOptions& options) {
  auto access = std::make_shared<const AccessRules>(
      ReadAccessRules(options.public_url, options.allowed_hosts, options.cors_origin));
  const Result<TrustedProxies> proxies = TrustedProxies::Read(options.trusted_proxies);
  if (!proxies) {
    Log(LogLevel::kError, "the trusted proxies stay", {{"error", proxies.error().message}});
  }
  const int connections = ConnectionsFor(options);
  if (connections < options.max_connections) {
    Log(LogLevel::kWarning, "fewer connections than http.maxConnections, for want of descriptors",
        {{"connections", std::int64_t{connections}}});
  }
  const std::lock_guard lock(mutex_);
  options_ = std::make_shared<const ServerOptions>(options);
  access_ = std::move(access);
  if (proxies) proxies_ = std::make_shared<const TrustedProxies>(*proxies);
  max_connections_ = connections;
}

void AsioServer::Serve(const Router& router, KeyGate& gate) {
  asio::co_spawn(acceptor_.get_executor(), Accept(router, gate), asio::detached);
  for (int i = 0; i < first_options_.io_threads; ++i) {
    threads_.emplace_back([this] { context_.run(); });
  }
}

bool AsioServer::Responds(std::chrono::milliseconds most) {
  const auto done = std::make_shared<std::promise<void>>();
  asio::post(context_, [done] { done->set_value(); });
  return done->get_future().wait_for(most) == std::future_status::ready;
}

asio::awaitable<void> AsioServer::Accept(const Router& router, KeyGate& gate) {
  while (!stopping_) {
    error_code failure;
    tcp::socket socket =
        co_await acceptor_.async_accept(asio::make_strand(context_), Into(failure));
    if (failure == asio::error::operation_aborted || !acceptor_.is_open()) break;
    // Such as: the process has no descriptors left. A pause lets some connections end.
    if (failure) {
      Log(LogLevel::kWarning, "cannot accept", {{"error", failure.message()}});
      asio::steady_timer pause(acceptor_.get_executor(), kAcceptPause);
      co_await pause.async_wait(Into(failure));
      continue;
    }
    Begin(router, gate, std::move(socket));
  }
}

void AsioServer::Begin(const Router& router, KeyGate& gate, tcp::socket socket) {
  error_code failure;
  const std::string peer = socket.remote_endpoint(failure).address().to_string();
  if (failure) return;
  socket.set_option(tcp::no_delay(true), failure);
  std::shared_ptr<Session> session;
  {
    const std::lock_guard lock(mutex_);
    const int count = static_cast<int>(sessions_.size());
    // The newest may ask for the service's health: the surplus connection that has said nothing for
    // the longest time makes room. With yet more even the answers 503 would cost too much.
    if (count >= max_connections_ + 2 * kSurplus) return;
    if (count >= max_connections_ + kSurplus && !surplus_.empty()) {
      surplus_.front()->Close();
      surplus_.pop_front();
    }
    const int from_there = ++by_address_[peer];
    // Behind a proxy there are many clients.
    const bool many = from_there > options_->max_connections_per_address && !proxies_->Has(peer);
    const bool surplus = count >= max_connections_ || many;
    session = std::make_shared<Session>(
        SessionContext{options_, access_, proxies_, router, gate, work_, stopping_, surplus},
        beast::tcp_stream(std::move(socket)), peer);
    sessions_.insert(session);
    if (surplus) surplus_.push_back(session);
  }
  const auto done = [this, session, peer](const std::exception_ptr& bug) {
    if (bug) Log(LogLevel::kError, "a connection ended in an exception", {{"peer", peer}});
    End(session, peer);
  };
  asio::co_spawn(session->executor(), session->Run(), done);
}

void AsioServer::End(const std::shared_ptr<Session>& session, const std::string& peer) {
  const std::lock_guard lock(mutex_);
  sessions_.erase(session);
  std::erase(surplus_, session);
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
  work_.uploads.join();
  work_.store.join();
  context_.stop();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

}  // namespace

Result<std::unique_ptr<Server>> Server::Bind(const ServerOptions& options) {
  const Result<TrustedProxies> proxies = TrustedProxies::Read(options.trusted_proxies);
  if (!proxies) return proxies.error();
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

bool IsLoopback(const std::string& host) {
  asio::io_context context;
  error_code failure;
  const auto found = tcp::resolver(context).resolve(host, "0", tcp::resolver::passive, failure);
  return !failure && !found.empty() && std::all_of(found.begin(), found.end(), [](const auto& one) {
    return one.endpoint().address().is_loopback();
  });
}

}  // namespace farhorizon
