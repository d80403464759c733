#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "service/handlers/key_gate.h"
#include "service/handlers/router.h"

namespace farhorizon {

struct ServerOptions {
  std::string host;
  std::uint16_t port = 0;  ///< 0: any that is free
  int io_threads = 2;
  int handler_threads = 8;  ///< for answers that wait for disk and database
  int upload_threads = 16;  ///< for uploads that are looked into
  std::size_t max_head_bytes = 16384;
  std::chrono::seconds head_time{10};   ///< from its first byte, and of a connection's first
  std::chrono::seconds idle_time{60};   ///< between requests, and without a byte of a body
  std::chrono::seconds body_grace{20};  ///< before body_bytes_per_second counts
  std::int64_t body_bytes_per_second = 1024;
  std::chrono::seconds write_time{30};  ///< for each 64 KiB that the client does not take
  int max_connections = 1024;
  int max_connections_per_address = 256;
  std::string public_url;       ///< its host and its pages are ours
  std::string allowed_hosts;    ///< further names of ours, a list with commas
  std::string cors_origin;      ///< origins whose pages may use the service, a list with commas
  std::string trusted_proxies;  ///< as TrustedProxies::Read takes it
};

/// The HTTP server: accepts connections and runs a Session on each.
class Server {
 public:
  /// Binds and listens; connections wait until Serve. Errors: kIo "cannot-listen";
  /// kInvalidArgument "invalid-config".
  static Result<std::unique_ptr<Server>> Bind(const ServerOptions& options);
  virtual ~Server() = default;
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] virtual std::uint16_t port() const = 0;

  /// Takes the limits and lists of `options` for connections that come from now on; its threads,
  /// host and port stay. A list of proxies that cannot be read stays as it was, and the log says
  /// so. Threads: safe.
  virtual void Reload(const ServerOptions& options) = 0;

  /// Starts the threads that answer. Requires: `router` and `gate` outlive Stop.
  virtual void Serve(const Router& router, KeyGate& gate) = 0;

  /// Whether the threads that move bytes do a task within `most`. Requires: Serve was called.
  virtual bool Responds(std::chrono::milliseconds most) = 0;

  /// Accepts no further connection, lets requests that are being answered end for at most `most`,
  /// then closes the rest.
  virtual void Stop(std::chrono::milliseconds most) = 0;

 protected:
  Server() = default;
};

struct HostPort {
  std::string host;
  std::uint16_t port = 0;
};
/// Reads "HOST:PORT" or "[::1]:PORT". Errors: kInvalidArgument "invalid-address".
Result<HostPort> ReadHostPort(const std::string& text);

/// Whether this machine alone can reach what listens on `host`, an address or a name: true if it
/// stands for addresses of loopback alone.
bool IsLoopback(const std::string& host);

}  // namespace farhorizon
